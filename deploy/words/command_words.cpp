// SPDX-License-Identifier: Apache-2.0
#include "deploy/words/command_words.h"

#include <fmt/format.h>

namespace indurop::deploy {

std::string command_text(const Command& command) {
  return fmt::format("indurop command\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n", command.plant, command.board, command.agent,
                     static_cast<int>(command.action), command.target, command.commander, command.nonce);
}

}  // namespace indurop::deploy
