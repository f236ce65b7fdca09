// SPDX-License-Identifier: Apache-2.0
// Orders to single boards and their answers (deploy/command_words.h) as DDS topics, beside those of deployments. No DDS
// here. Used by the thread that uses the DeployLink, which outlives it and tells when something came.

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deploy/command_words.h"

namespace indurop::mirror {

class DeployLink;

// An agent hears orders and answers, a commander the other way round.
enum class CommandSide { Agent, Commander };

class CommandLink {
 public:
  // Null, and `problem` says why, if it cannot be had.
  static std::unique_ptr<CommandLink> open(DeployLink& link, CommandSide side, std::string& problem);
  CommandLink(const CommandLink&) = delete;
  CommandLink& operator=(const CommandLink&) = delete;
  ~CommandLink();

  // Nothing that is said is kept for late joiners: commanders repeat themselves.
  void send(const deploy::Command& command);
  void send(const deploy::CommandReply& reply);
  std::vector<deploy::Command> take_commands();
  std::vector<deploy::CommandReply> take_replies();

 private:
  struct Impl;
  explicit CommandLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace indurop::mirror
