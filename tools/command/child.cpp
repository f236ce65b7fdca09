// SPDX-License-Identifier: Apache-2.0
#include "tools/command/child.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>

#include "base/spawn.h"

namespace indurop::tools {

int run_child(const std::vector<std::string>& arguments, std::string& problem) {
  const auto child = base::spawn({.words = arguments, .program = {}});
  if (!child) {
    problem = fmt::format("cannot start {}: {}", arguments[0], std::strerror(child.error().sys_errno));
    return -1;
  }
  int status = 0;
  while (::waitpid(*child, &status, 0) < 0) {
    if (errno != EINTR) {
      problem = fmt::format("lost {}: {}", arguments[0], std::strerror(errno));
      return -1;
    }
  }
  return base::exit_code_of(status);
}

}  // namespace indurop::tools
