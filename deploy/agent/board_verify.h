// SPDX-License-Identifier: Apache-2.0
// The files of this board compared with their digests because somebody asks for it, piece by piece beside the agent's
// other work. What is damaged is dropped, and made again from what the board has besides.
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

  // What was found for the question with this name; the first time it is asked, the check begins or waits for another.
  std::string answer(const std::string& question);
  // Goes on with the check. When one has ended that found damage: what is still wrong with the committed deployment,
  // empty if it is whole.
  std::optional<std::string> step();
  [[nodiscard]] bool busy() const noexcept { return check_.has_value(); }

 private:
  std::string mend(const StateReport& report);
  [[nodiscard]] std::string text_of(const StateReport& report) const;

  AgentState& state_;
  std::string question_;  // under way
  std::optional<StateCheck> check_;
  std::map<std::string, std::string> answers_;  // by question, the newest
};

}  // namespace indurop::deploy
