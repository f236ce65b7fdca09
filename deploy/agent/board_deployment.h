// SPDX-License-Identifier: Apache-2.0
// A deployment as seen by one board: whether the board is part of it, whether its files are intact, and how it is
// committed. Knows the board's disk and plants, but neither the network nor the node.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/agent/agent_state.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class BoardDeployment {
 public:
  // `one_host`: several boards share the machine, so the plant is not compared with the machine.
  BoardDeployment(AgentState& state, std::string board, bool one_host)
      : state_(state), board_(std::move(board)), one_host_(one_host) {}

  [[nodiscard]] bool belongs(const std::vector<std::string>& members) const;
  // Returns true if another board has a deployment that this one takes over: this board missed one of its plant (which
  // may be the one that removes it), or its copy of the same deployment is `damaged`.
  [[nodiscard]] bool lacks(const BoardReport& other, bool damaged) const;
  // Returns the path of the manifest when it is installed; empty if there is none, or the board is not part of it.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Verifies every file of the deployment on this board, and restores damaged ones from other copies on it: to be
  // called each time before it is run. A problem names the file.
  Result<void, base::Problem> verify(const std::string& id) { return state_.install(id); }
  // Installs it and checks the whole plant on this board's copy; returns the first error, if any. A deployment that
  // leaves the board out always passes.
  Result<void, base::Problem> check(const Order& order);
  // Commits it. With a problem nothing has changed.
  Result<void, base::Problem> commit(const Order& order);
  // Records the rollback in the history; the committed deployment stays.
  Result<void, base::Problem> note_rollback(const Order& order, const std::string& why);

 private:
  [[nodiscard]] bool leaves(const std::string& id) const;

  AgentState& state_;
  std::string board_;
  bool one_host_;
};

}  // namespace indurop::deploy
