// SPDX-License-Identifier: Apache-2.0
// A program started by a test, with what it prints; killed at the latest when the object ends.

#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tests/support/wait_until.h"

namespace indurop::test {

struct Environment {
  std::vector<std::string> variables{};  // "NAME=value" on top of the test's own
  uid_t user = static_cast<uid_t>(-1);   // run as this user (needs root)
  std::function<bool()> prepare{};       // runs in the new process before the program; false: the program is not run
  bool one_output = false;               // what it says on stderr comes with what it prints on stdout
  std::string stdout_to{};               // a file instead of out()
};

// What a program that ended leaves.
struct Outcome {
  int code = -1;  // exit code, or 128 + signal; -1 if it had to be killed
  std::string out{};
  std::string err{};
  // `out` read as JSON; a discarded value if it is none.
  [[nodiscard]] nlohmann::json json() const;
};

class Program {
 public:
  // Exit code of a program whose preparation failed.
  static constexpr int kNotPrepared = 126;

  explicit Program(const std::vector<std::string>& command, const Environment& environment = {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program();

  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  [[nodiscard]] bool running();
  void signal(int number) const;
  void kill();
  // Exit code or 128 + signal once it has ended; -1 if it does not.
  int wait(std::chrono::milliseconds patience = kPatience);
  // Ends its stdin and waits for its end, at most twice as long as for other things; kills it then.
  Outcome finish();

  void input(const std::string& text) const;
  [[nodiscard]] std::string out() const { return contents(out_); }
  [[nodiscard]] std::string err() const { return contents(err_); }
  bool prints(const std::string& text);  // on stdout, sooner or later
  bool says(const std::string& text);    // on stderr

 private:
  static std::string contents(int file);
  int in_ = -1;
  int out_ = -1;
  int err_ = -1;
  pid_t pid_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

// False also for a process that has ended and that its parent has not asked about yet.
bool alive(pid_t pid);

// Of a process that does not exist any more.
pid_t dead_pid();

// Makes mounts of the calling process, which has one thread, its own. False if it may not.
bool own_mounts();

// Gives the calling process, which has one thread, and those it starts a network of their own, in which they may do
// all. False if it may not.
bool own_network();

// For Environment::prepare: a private view of the file system with an empty one of this size at `folder`.
bool mount_small(const std::string& folder, const std::string& size);

}  // namespace indurop::test
