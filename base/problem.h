// SPDX-License-Identifier: Apache-2.0
// What went wrong, in words for whoever runs a program: the error of calls whose reason a number cannot tell, as in
// Result<Plan, Problem>. If it is about a place in a file: base/diagnostic.h.

#pragma once

#include <string>

namespace indurop::base {

struct Problem {
  std::string text;   // what, and what to do; one line, without "error:"
  int sys_errno = 0;  // what the system said when a file could not be written; 0: it was something else
};

}  // namespace indurop::base
