// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/node_command.h"

namespace indurop::deploy {

NodeCommand::Answer NodeCommand::begin(Action action, const std::string& by) {
  if (action == Action::StopNode && !process_.held().empty() && !process_.has_node()) {
    return {Outcome::Unchanged, {}};
  }
  if (action == Action::StartNode && process_.condition() == NodeCondition::Running) {
    return {Outcome::Unchanged, {}};
  }
  ended_ = action == Action::StartNode;
  if (ended_) {
    process_.release();
  } else {
    process_.hold("stopped by command from " + by);
  }
  return {Outcome::UnderWay, {}};
}

std::optional<NodeCommand::Answer> NodeCommand::poll(Action action) {
  if (!ended_) {
    if (process_.has_node()) {
      return std::nullopt;
    }
    if (action == Action::StopNode) {
      return Answer{Outcome::Done, {}};
    }
    ended_ = true;
    process_.release();
    return std::nullopt;
  }
  if (process_.condition() == NodeCondition::Running) {
    return Answer{Outcome::Done, {}};
  }
  const bool failed =
      process_.condition() == NodeCondition::Failed || process_.condition() == NodeCondition::Restarting;
  return failed ? std::optional(Answer{Outcome::Failed, process_.reason()}) : std::nullopt;
}

}  // namespace indurop::deploy
