// SPDX-License-Identifier: Apache-2.0
// Commands to single boards and their answers (deploy/words/command_words.h) as DDS topics, in addition to those of
// deployments. Without DDS. Used by the thread that uses the DeployLink, which outlives it and signals when something
// has arrived.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "deploy/words/command_words.h"

namespace indurop::deploy {

class DeployLink;

// An agent receives commands and answers them, a commander sends commands and receives the answers.
enum class CommandSide { Agent, Commander };

class CommandLink {
 public:
  // The link is never null; a problem if it cannot be opened.
  static Result<std::unique_ptr<CommandLink>, base::Problem> open(DeployLink& link, CommandSide side);
  CommandLink(const CommandLink&) = delete;
  CommandLink& operator=(const CommandLink&) = delete;
  ~CommandLink();

  // Messages are not kept for late joiners: commanders repeat them.
  void send(const Command& command);
  void send(const CommandReply& reply);
  std::vector<deploy::Command> take_commands();
  std::vector<deploy::CommandReply> take_replies();

 private:
  struct Impl;
  explicit CommandLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::deploy
