// SPDX-License-Identifier: Apache-2.0
#include "tools/child.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>

namespace indurop::tools {

int run_child(const std::vector<std::string>& arguments, std::string& problem) {
  std::vector<char*> pointers;
  for (const std::string& one : arguments) {
    pointers.push_back(const_cast<char*>(one.c_str()));  // NOLINT(cppcoreguidelines-pro-type-const-cast): POSIX
  }
  pointers.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, pointers[0], nullptr, nullptr, pointers.data(), environ);
  if (error != 0) {
    problem = fmt::format("cannot start {}: {}", arguments[0], std::strerror(error));
    return -1;
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      problem = fmt::format("lost {}: {}", arguments[0], std::strerror(errno));
      return -1;
    }
  }
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace indurop::tools
