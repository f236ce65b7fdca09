// SPDX-License-Identifier: Apache-2.0
// Values that clients want to be set: requests to `indurop serve`, which decides and notes them in its audit log. They
// are made one after the other on a thread of its own, because a board of another host may take seconds.

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "doors/mqtt/mailbox.h"
#include "doors/mqtt/serve/http.h"

namespace indurop::mqtt {

// The answer of the server: {"board", "written"}, or {"error", "message", "details"}.
struct CommandResult {
  bool done = false;
  base::Json answer;
};

struct Command {
  std::string board;
  base::Json values;  // object of NAME: value
  std::string reason;
  std::string token;                               // of the user; empty: nothing is requested, the command is refused
  std::function<void(const CommandResult&)> then;  // called by the thread of the mailbox
};

class Commands {
 public:
  static constexpr std::size_t kMostWaiting = 100;

  Commands(ServeAccess access, Mailbox& mailbox);
  // What was not requested yet is abandoned.
  ~Commands();

  // Answers at once if the command has no token, or too many wait.
  void add(Command command);

 private:
  void run();
  CommandResult request(const Command& command) const;

  ServeAccess access_;
  Mailbox* mailbox_;
  std::mutex mutex_;
  std::condition_variable more_;
  std::deque<Command> waiting_;
  bool stopped_ = false;
  std::thread thread_;
};

// {"error", "message"}
CommandResult refused_command(const char* error, const std::string& message);

// A user of `indurop serve` and the token to act in that name.
struct UserToken {
  std::string user;
  std::string token;
};
// Reads lines NAME TOKEN; what follows on a line is ignored, as are empty lines and those that begin with '#'. Errors
// name file and line.
Result<std::vector<UserToken>, base::Problem> read_tokens(const std::filesystem::path& file);

}  // namespace indurop::mqtt
