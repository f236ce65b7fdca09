// SPDX-License-Identifier: Apache-2.0
// Compares the files of this board with their digests on request, piece by piece between the agent's other work.
// Damaged files are discarded, and restored from other copies on the board.
//   The text: {"done": false}, or {"done": true, "files", "bytes", "deployments",
//              "damaged": [{"file", "name", "sha256", "found", "repaired"}]}

#pragma once

#include <map>
#include <optional>
#include <string>

#include "deploy/agent/agent_state.h"
#include "deploy/disk/state_check.h"

namespace indurop::deploy {

class BoardVerify {
 public:
  explicit BoardVerify(AgentState& state) : state_(state) {}

  // Returns the findings for the request with this name; at the first call the check begins, or waits for another one.
  std::string answer(const std::string& question);
  // Continues the check. When a check that found damage has ended, returns what is still wrong with the committed
  // deployment, empty if it is intact.
  std::optional<std::string> step();
  [[nodiscard]] bool busy() const noexcept { return check_.has_value(); }

 private:
  std::string mend(const StateReport& report);
  [[nodiscard]] std::string text_of(const StateReport& report) const;

  AgentState& state_;
  std::string question_;  // under way
  std::optional<StateCheck> check_;
  std::map<std::string, std::string> answers_;  // by request, the newest
};

}  // namespace indurop::deploy
