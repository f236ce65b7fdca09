// SPDX-License-Identifier: Apache-2.0
// What a change from one deployment to another means for a board, as far as its files say it: which modules go on,
// which of them have another version, whether the schedule differs, and why the node would have to be restarted.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "deploy/agent/agent_state.h"
#include "deploy/transaction/board_plan.h"
#include "store/operate/exchange_set.h"

namespace indurop::deploy {

struct DeploymentChange {
  BoardPlan plan;                                      // Exchanged: of all that have another version
  std::vector<operate::SetRequest::Module> exchanged;  // only if the node need not be restarted
  // Of the schedule that follows, and of what the boards exchange then. Empty: the node has to be restarted.
  std::string manifest;
};

// Both deployments are installed on the board. `running`: SHA-256 of the versions that run, by module; modules that are
// not in it run what was deployed. Not real-time safe.
DeploymentChange change_between(const AgentState& state, const std::string& board, const std::string& from,
                                const std::string& to, const std::map<std::string, std::string>& running);

}  // namespace indurop::deploy
