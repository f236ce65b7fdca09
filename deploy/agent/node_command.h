// SPDX-License-Identifier: Apache-2.0
// Stops, starts and restarts the node of the board by command.

#pragma once

#include <optional>
#include <string>

#include "deploy/agent/board_process.h"
#include "deploy/words/command_words.h"

namespace indurop::deploy {

class NodeCommand {
 public:
  explicit NodeCommand(BoardProcess& process) : process_(process) {}

  struct Answer {
    Outcome outcome;
    std::string text;
  };
  // `action`: one of the three about nodes; `by`: who commands it, for the reason that the board shows.
  Answer begin(Action action, const std::string& by);
  // Continues it. Returns nothing while it is under way.
  std::optional<Answer> poll(Action action);

 private:
  BoardProcess& process_;
  bool ended_ = false;  // the first half of a restart is done
};

}  // namespace indurop::deploy
