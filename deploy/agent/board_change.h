// SPDX-License-Identifier: Apache-2.0
// How the node of this board gets from one deployment to another and back: by an exchange of modules while it runs, or
// by a restart.

#pragma once

#include <optional>
#include <string>

#include "core/base/log.h"
#include "deploy/agent/board_deployment.h"
#include "deploy/agent/board_exchange.h"
#include "deploy/agent/board_process.h"
#include "deploy/words/deployment_words.h"

namespace indurop::deploy {

class BoardChange {
 public:
  // All references are borrowed.
  BoardChange(AgentState& state, const std::string& board, const BoardDeployment& deployment, BoardProcess& process,
              const base::Log& log)
      : state_(state), board_(board), deployment_(deployment), process_(process), log_(log), exchange_(state, board) {}

  // The agent has started: a node that outlived it runs the committed deployment again, if it knows it.
  void resume();
  // A deployment begins.
  void begin();
  // Loads what differs next to what runs, or compares only; poll() returns the answer.
  void load(const Order& order);
  // Exchanges it at this time; poll() returns the answer. `alone`: this board takes over what the others have.
  void enter(const Order& order, rt::MonoTime at, bool alone);
  void restart(const Order& order);
  void commit(const Order& order);
  void go_back(Way way);
  void forget();

  std::optional<BoardExchange::Answer> poll(const Order& order);
  // During a trial.
  BoardProcess::Health health(const Order& order);
  // Text of a BoardPlan; empty: nothing is planned.
  [[nodiscard]] const std::string& plan() const noexcept { return exchange_.plan(); }
  [[nodiscard]] std::int64_t grid_ns() const noexcept { return exchange_.grid_ns(); }

 private:
  // A node that was exchanged runs from the folder that it was started in.
  void keep_folder_of_node() { state_.keep_folder_of(BoardProcess::manifest_of_node(board_)); }

  AgentState& state_;
  const std::string& board_;
  const BoardDeployment& deployment_;
  BoardProcess& process_;
  const base::Log& log_;
  BoardExchange exchange_;
  std::string held_before_;  // hold reason before the trial
};

}  // namespace indurop::deploy
