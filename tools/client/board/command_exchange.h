// SPDX-License-Identifier: Apache-2.0
// One command to a board until its final answer: requests a number that is valid once, signs, repeats. Sends nothing
// itself: its owner does, and passes what has arrived.

#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "deploy/words/command_words.h"
#include "tools/client/board/deploy_key.h"

namespace indurop::tools {

class CommandExchange {
 public:
  // `key`: signs the command; empty: it is not signed.
  CommandExchange(deploy::Command command, CommandKey key) : command_(std::move(command)), key_(std::move(key)) {}

  [[nodiscard]] const deploy::Command& command() const noexcept { return command_; }
  // The time when command() is to be sent, for the first time or again (CLOCK_MONOTONIC). To be called then: sent().
  [[nodiscard]] std::int64_t due_ns() const noexcept { return due_ns_; }
  void sent(std::int64_t now_ns) noexcept;
  // Returns whether this is the final answer.
  bool take(const deploy::CommandReply& reply);
  // Returns whether the board has accepted the command, and is not done.
  [[nodiscard]] bool under_way() const noexcept { return under_way_; }

 private:
  deploy::Command command_;
  CommandKey key_;
  std::int64_t due_ns_ = 0;
  bool under_way_ = false;
};

}  // namespace indurop::tools
