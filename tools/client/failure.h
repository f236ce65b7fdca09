// SPDX-License-Identifier: Apache-2.0
// Why a program cannot continue: the error type of functions that programs call.

#pragma once

#include <indurop/result.h>

#include <string>

#include "core/base/exit_code.h"

namespace indurop::tools {

struct Failure {
  int code = kFailed;  // exit code for a program that ends with this failure
  std::string text;    // empty: it was said already (messages.h)
};

}  // namespace indurop::tools
