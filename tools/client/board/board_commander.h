// SPDX-License-Identifier: Apache-2.0
// Sends one command to a board and waits for the result: requests a number that is valid once, signs, repeats.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "deploy/link/command_link.h"
#include "deploy/link/deploy_link.h"
#include "deploy/words/command_words.h"
#include "tools/client/board/deploy_key.h"
#include "tools/client/failure.h"
#include "tools/client/messages.h"

namespace indurop::tools {

struct Answered {
  deploy::CommandReply reply;  // Done, Unchanged, Failed or Refused
  std::int64_t took_ns = 0;
};

class BoardCommander {
 public:
  // Signs with the key in this folder of the plant's keys; empty: unsigned, which boards without keys accept.
  static Result<BoardCommander, Failure> make(Messages& messages, const std::filesystem::path& keys);

  // Signs nothing, for commands whose content is signed.
  static BoardCommander unsigned_commands() { return BoardCommander({}); }

  // `self`: session of the link. `meanwhile` is called whenever something may have arrived, and at once again if it
  // returns true. Fails if no final answer comes in time, or the user interrupts.
  Result<Answered, Failure> send(deploy::DeployLink& link, std::uint64_t self, const deploy::BoardReport& board,
                                 deploy::Action action, const std::string& target, std::int64_t timeout_ns,
                                 const std::function<bool()>& meanwhile = {});
  // Returns the signature of a text by the key that signs commands; empty without one.
  [[nodiscard]] std::string signature_of(const std::string& text) const { return command_signature(key_, text); }

 private:
  explicit BoardCommander(CommandKey key) : key_(std::move(key)) {}

  CommandKey key_;
  std::unique_ptr<deploy::CommandLink> commands_;
};

}  // namespace indurop::tools
