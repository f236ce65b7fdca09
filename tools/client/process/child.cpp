// SPDX-License-Identifier: Apache-2.0
#include "tools/client/process/child.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>

namespace indurop::tools {

Result<int, base::Problem> run_child(const std::vector<std::string>& arguments, int output) {
  return run_child(base::Launch{.words = arguments, .program = {}, .output = output});
}

Result<int, base::Problem> run_child(const base::Launch& launch) {
  const std::string& program = launch.words[0];
  const auto child = base::spawn(launch);
  if (!child) {
    return base::Problem{fmt::format("cannot start {}: {}", program, std::strerror(child.error().sys_errno))};
  }
  int status = 0;
  while (::waitpid(*child, &status, 0) < 0) {
    if (errno != EINTR) {
      return base::Problem{fmt::format("lost {}: {}", program, std::strerror(errno))};
    }
  }
  return base::exit_code_of(status);
}

}  // namespace indurop::tools
