// SPDX-License-Identifier: Apache-2.0
// What a deployment is to one board: whether the board is part of it, whether it is sound there, and how it becomes the
// committed one. Knows the board's disk and plants, but neither the network nor the node.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "deploy/deployment_words.h"
#include "node/agent_state.h"

namespace indurop::node {

class BoardDeployment {
 public:
  // `one_host`: several boards share the machine, so nothing is compared with it.
  BoardDeployment(AgentState& state, std::string board, bool one_host)
      : state_(state), board_(std::move(board)), one_host_(one_host) {}

  [[nodiscard]] bool belongs(const std::vector<std::string>& members) const;
  // Installed on this board; empty if there is none, or the board is not part of it.
  [[nodiscard]] std::filesystem::path manifest(const std::string& id) const;
  // Installs it and checks the whole plant on this board's copy. Empty, or the first error. One that leaves the board
  // out is always right.
  std::string check(const deploy::Order& order);
  // Empty, or what went wrong; then nothing has changed.
  std::string commit(const deploy::Order& order);
  // History tells it; what is committed stays.
  std::string note_rollback(const deploy::Order& order, const std::string& why);

 private:
  [[nodiscard]] bool leaves(const std::string& id) const;

  AgentState& state_;
  std::string board_;
  bool one_host_;
};

}  // namespace indurop::node
