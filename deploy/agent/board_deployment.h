// SPDX-License-Identifier: Apache-2.0
// What a deployment is to one board: whether the board is part of it, whether it is sound there, and how it becomes the
// committed one. Knows the board's disk and plants, but neither the network nor the node.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/agent/agent_state.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class BoardDeployment {
 public:
  // `one_host`: several boards share the machine, so nothing is compared with it.
  BoardDeployment(AgentState& state, std::string board, bool one_host)
      : state_(state), board_(std::move(board)), one_host_(one_host) {}

  [[nodiscard]] bool belongs(const std::vector<std::string>& members) const;
  // Another board has a deployment that this one takes over: it missed one of its plant, which may be the one that
  // leaves it out, or what it has of the same is `damaged`.
  [[nodiscard]] bool lacks(const BoardReport& other, bool damaged) const;
  // Where it is when it is installed; empty if there is none, or the board is not part of it.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Every file of it on this board is what was deployed, or is made so from what the board has besides: to be asked
  // each time before it is run. A problem names the file.
  Result<void, base::Problem> verify(const std::string& id) { return state_.install(id); }
  // Installs it and checks the whole plant on this board's copy: the first error, if there is one. One that leaves the
  // board out is always right.
  Result<void, base::Problem> check(const Order& order);
  // With a problem nothing has changed.
  Result<void, base::Problem> commit(const Order& order);
  // History tells it; what is committed stays.
  Result<void, base::Problem> note_rollback(const Order& order, const std::string& why);

 private:
  [[nodiscard]] bool leaves(const std::string& id) const;

  AgentState& state_;
  std::string board_;
  bool one_host_;
};

}  // namespace indurop::deploy
