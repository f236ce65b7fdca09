// SPDX-License-Identifier: Apache-2.0
#include "deploy/words/deployment_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace indurop::deploy {

const char* to_text(Phase phase) noexcept {
  switch (phase) {
    case Phase::Steady:
      return "steady";
    case Phase::Fetching:
      return "fetching";
    case Phase::Checking:
      return "checking";
    case Phase::Prepared:
      return "prepared";
    case Phase::Trial:
      return "trial";
    case Phase::Healthy:
      return "healthy";
    case Phase::Failed:
      return "failed";
  }
  return "?";
}

const char* to_text(NodeCondition condition) noexcept {
  switch (condition) {
    case NodeCondition::None:
      return "empty";
    case NodeCondition::Starting:
      return "starting";
    case NodeCondition::Running:
      return "running";
    case NodeCondition::Stopping:
      return "stopping";
    case NodeCondition::Restarting:
      return "restarting";
    case NodeCondition::Failed:
      return "failed";
    case NodeCondition::Stopped:
      return "stopped";
  }
  return "?";
}

std::string grant_text(const std::string& plant, const std::string& deployment, std::uint64_t generation) {
  return fmt::format("indurop deployment\n{}\n{}\n{}\n", plant, deployment, generation);
}

std::string order_text(const Order& order) {
  return fmt::format("indurop order\n{}{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n",
                     grant_text(order.plant, order.deployment, order.generation), order.deployer, order.size,
                     static_cast<int>(order.step), order.said_at_ns, order.switch_at_ns, order.health_ns,
                     static_cast<int>(order.way), fmt::join(order.boards, ","));
}

std::string describe(const OtherAgent& agent, unsigned own_protocol) {
  return fmt::format("{}{} uses protocol {} of another release, this one uses {}: install the same release on both",
                     agent.board.empty() ? "an agent" : "the agent of board " + agent.board,
                     agent.host.empty() ? "" : " on " + agent.host, agent.protocol, own_protocol);
}

std::string describe(const Impostor& impostor) {
  return impostor.board.empty()
             ? fmt::format(
                   "a participant with keys of the plant reports in the name of board {}; its reports are rejected: "
                   "find out which keys are compromised (indurop keys list), and revoke them",
                   impostor.claimed)
             : fmt::format(
                   "board {} reports in the name of board {}; its reports are rejected: its keys may be compromised "
                   "(indurop keys revoke {})",
                   impostor.board, impostor.claimed, impostor.board);
}

}  // namespace indurop::deploy
