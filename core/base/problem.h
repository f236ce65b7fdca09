// SPDX-License-Identifier: Apache-2.0
// An error in words for the user of a program: the error type of calls whose reason does not fit into a number, as in
// Result<Plan, Problem>. For errors about a place in a file: core/base/diagnostic.h.

#pragma once

#include <string>

namespace indurop::base {

struct Problem {
  std::string text;   // what is wrong, and what to do; one line, without "error:"
  int sys_errno = 0;  // errno when a file could not be written; 0: another cause
};

}  // namespace indurop::base
