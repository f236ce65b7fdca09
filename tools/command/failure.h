// SPDX-License-Identifier: Apache-2.0
// Why a verb cannot go on: the error of what it calls on its way.

#pragma once

#include <indurop/result.h>

#include <string>

#include "base/exit_code.h"
#include "tools/command/output.h"

namespace indurop::tools {

struct Failure {
  int code = kFailed;
  std::string text;  // empty: it was said already
};

// Says it and returns the exit code.
inline int report(Output& out, const Failure& failure) {
  if (!failure.text.empty()) {
    out.error(failure.text);
  }
  return failure.code;
}

}  // namespace indurop::tools
