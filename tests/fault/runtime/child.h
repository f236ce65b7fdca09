// SPDX-License-Identifier: Apache-2.0
// A program started by a test, with what it prints; killed at the latest when the object ends.

#pragma once

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "test_node.h"

namespace indurop::testing {

class Child {
 public:
  Child(const std::string& program, const std::string& node, const std::string& module,
        const std::vector<std::string>& arguments = {})
      : output_(::memfd_create("output", MFD_CLOEXEC)) {
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(output_, STDOUT_FILENO);
      ::dup2(output_, STDERR_FILENO);
      ::setenv("INDUROP_NODE", node.c_str(), 1);
      module.empty() ? ::unsetenv("INDUROP_MODULE") : ::setenv("INDUROP_MODULE", module.c_str(), 1);
      ::execv(program.c_str(), argv.data());
      ::_exit(127);
    }
  }
  ~Child() {
    kill();
    ::close(output_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  void kill() {
    if (!ended_) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, &status_, 0);
      ended_ = true;
    }
  }
  // Exit code once it has ended by itself; -1 if it did not.
  int exit_code() {
    if (!wait_until([this] { return ended_ = ended_ || ::waitpid(pid_, &status_, WNOHANG) == pid_; })) {
      return -1;
    }
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  }
  [[nodiscard]] bool running() {
    ended_ = ended_ || ::waitpid(pid_, &status_, WNOHANG) == pid_;
    return !ended_;
  }
  [[nodiscard]] std::string output() const {
    char text[8192];
    const ssize_t n = ::pread(output_, text, sizeof text, 0);
    return {text, static_cast<std::size_t>(n > 0 ? n : 0)};
  }
  bool prints(const std::string& text) {
    return wait_until([&] { return output().find(text) != std::string::npos; });
  }

 private:
  int output_;
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

// Pid of a process that does not exist any more.
inline pid_t dead_pid() {
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::_exit(0);
  }
  ::waitpid(pid, nullptr, 0);
  return pid;
}

}  // namespace indurop::testing
