// SPDX-License-Identifier: Apache-2.0
// Commands to single boards and their answers (deploy/words/command_words.h) as DDS topics, beside those of
// deployments. No DDS here. Used by the thread that uses the DeployLink, which outlives it and tells when something
// came.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>
#include <vector>

#include "base/problem.h"
#include "deploy/words/command_words.h"

namespace indurop::deploy {

class DeployLink;

// An agent hears commands and answers, a commander the other way round.
enum class CommandSide { Agent, Commander };

class CommandLink {
 public:
  // Never null; a problem if it cannot be had.
  static Result<std::unique_ptr<CommandLink>, base::Problem> open(DeployLink& link, CommandSide side);
  CommandLink(const CommandLink&) = delete;
  CommandLink& operator=(const CommandLink&) = delete;
  ~CommandLink();

  // Nothing that is said is kept for late joiners: commanders repeat themselves.
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
