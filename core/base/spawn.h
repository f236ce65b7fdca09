// SPDX-License-Identifier: Apache-2.0
// Starts another program. The memory of this process is left alone (no fork, unless the program is to end with us), so
// real-time threads do not fault on their pages afterwards.

#pragma once

#include <indurop/result.h>
#include <sys/types.h>

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::base {

struct Launch {
  // Ctrl-C in a terminal reaches the foreground process group, the end of the terminal its session.
  enum class Group { Ours, Own, OwnSession };

  std::vector<std::string> words;  // the program's name as it sees it, then its arguments
  std::filesystem::path program;   // empty: words[0], searched in PATH
  std::optional<std::vector<std::string>> environment = std::nullopt;  // "NAME=value"; ours if not given
  Group group = Group::Ours;
  int input = -1;              // an open file for standard input; -1: ours
  int output = -1;             // an open file for standard output, and error unless `errors` is given; -1: ours
  int errors = -1;             // an open file for standard error; -1: that of output
  int inherits = -1;           // a file the program gets under the same number, although closed to others; -1: none
  bool fresh_signals = false;  // no signal is blocked or ignored, whatever we do
  // The signal the program gets when the thread that starts it ends; 0: it lives on. Costs a fork: not in real-time
  // processes.
  int ends_with_us = 0;
};

// Returns our environment without these variables, for Launch::environment.
std::vector<std::string> environment_without(std::initializer_list<std::string_view> names);

// A program started by one that ignores SIGCHLD ignores it, too, and the system then drops how its children end: ends
// this, so that waitpid() works. spawn() does it; call it before fork().
void keep_ends_of_children() noexcept;

// Starts a program; the caller waits for it. Files opened with O_CLOEXEC are passed on only as stated above. Errors:
// System, with the errno; with ends_with_us, a program that cannot be run is reported by exit code 127. Not real-time
// safe.
Result<pid_t> spawn(const Launch& launch);

// Returns the exit code of a status of waitpid as shells do: 128 + number after a signal.
int exit_code_of(int wait_status) noexcept;

}  // namespace indurop::base
