// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/child.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>

#include "core/base/spawn.h"

namespace indurop::tools {

Result<int, base::Problem> run_child(const std::vector<std::string>& arguments, int output) {
  const auto child = base::spawn({.words = arguments, .program = {}, .output = output});
  if (!child) {
    return base::Problem{fmt::format("cannot start {}: {}", arguments[0], std::strerror(child.error().sys_errno))};
  }
  int status = 0;
  while (::waitpid(*child, &status, 0) < 0) {
    if (errno != EINTR) {
      return base::Problem{fmt::format("lost {}: {}", arguments[0], std::strerror(errno))};
    }
  }
  return base::exit_code_of(status);
}

}  // namespace indurop::tools
