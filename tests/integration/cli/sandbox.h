// SPDX-License-Identifier: Apache-2.0
// A /dev/shm and a state directory of the test's own, programs run in it with what they print, and fake nodes.

#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace indurop::test {

struct Outcome {
  int code = -1;  // exit code, or 128 + signal
  std::string out;
  std::string err;
};

// Gives this process a private, empty /dev/shm, an empty one again at each further call. False if the system does not
// allow that.
bool enter_sandbox();

// Folder for this process's files, removed at its end; $INDUROP_STATE_DIR of all programs run lies in it.
std::filesystem::path scratch();

struct RunOptions {
  std::vector<std::string> environment{};  // "NAME=value" on top of ours
  uid_t user = static_cast<uid_t>(-1);     // run as this user (needs root)
  std::string stdout_to{};                 // file instead of a pipe
  std::string input{};                     // on stdin
  int seconds = 20;                        // then it is killed and `code` is -1
};

// Runs `indurop` with these arguments to its end.
Outcome indurop(const std::vector<std::string>& arguments, const RunOptions& options = {});

// A program in the background; killed by the destructor.
class Background {
 public:
  explicit Background(const std::vector<std::string>& command, const std::vector<std::string>& environment = {});
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background();
  // Everything printed so far, after waiting until it contains `text`; gives up after ten seconds.
  bool wait_for(const std::string& text);
  [[nodiscard]] const std::string& output() const { return output_; }
  void signal(int number) const;
  // Exit code, 128 + signal, or -1 if it has not ended in ten seconds.
  int wait();
  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  bool read_more(int timeout_ms);
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::string output_;
};

std::vector<std::string> fake_node(const std::string& name, const std::vector<std::string>& more = {});
std::vector<std::string> indurop_command(const std::vector<std::string>& arguments);

}  // namespace indurop::test
