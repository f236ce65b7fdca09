// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/box_watch.h"

#include <fmt/format.h>

namespace indurop::deploy {

std::optional<std::string> BoxWatch::note_report(const BoardReport& report) {
  const Known now{report.agent, report.faults, report.overruns, report.tick, report.node};
  const auto found = known_.find(report.board);
  if (found == known_.end() || found->second.agent != report.agent) {
    known_[report.board] = now;
    return std::nullopt;
  }
  const Known before = found->second;
  found->second = now;
  const bool died = before.node == NodeCondition::Running &&
                    (now.node == NodeCondition::Restarting || now.node == NodeCondition::Failed);
  if (died) {
    return fmt::format("the node of board {} ended: {}", report.board, report.message);
  }
  // A new run of its node starts counting again.
  if (before.node != NodeCondition::Running || now.node != NodeCondition::Running || now.tick < before.tick) {
    return std::nullopt;
  }
  if (now.faults > before.faults) {
    return fmt::format("a module of board {} faulted near its tick {}", report.board, now.tick);
  }
  if (now.overruns >= before.overruns + kManyOverruns) {
    return fmt::format("board {} had {} overruns up to its tick {}", report.board, now.overruns - before.overruns,
                       now.tick);
  }
  return std::nullopt;
}

std::optional<std::string> BoxWatch::gone(const BoardReport& report) {
  const auto found = known_.find(report.board);
  const bool ran =
      found != known_.end() && found->second.agent == report.agent && found->second.node == NodeCondition::Running;
  if (ran) {
    known_.erase(found);
  }
  return ran ? std::optional(fmt::format("board {} no longer reports", report.board)) : std::nullopt;
}

}  // namespace indurop::deploy
