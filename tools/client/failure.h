// SPDX-License-Identifier: Apache-2.0
// Why a verb cannot continue: the error type of the functions it calls.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/exit_code.h"
#include "tools/cli/command/output.h"

namespace indurop::tools {

struct Failure {
  int code = kFailed;
  std::string text;  // empty: it was printed already
};

// Prints the failure and returns the exit code.
inline int report(Output& out, const Failure& failure) {
  if (!failure.text.empty()) {
    out.error(failure.text);
  }
  return failure.code;
}

}  // namespace indurop::tools
