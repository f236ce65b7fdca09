// SPDX-License-Identifier: Apache-2.0
// Lets the node of this board change to another deployment without a restart: the modules that differ are loaded next
// to those that run, another schedule is built next to the one that counts, both are exchanged at one tick, and, when
// the plant has decided, kept or exchanged back. The node does that on its own; the agent only requests it, so that
// nothing is lost if one of both is killed.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/rt/clock.h"
#include "deploy/agent/agent_state.h"
#include "deploy/agent/deployment_change.h"
#include "scheduler/module_command.h"
#include "scheduler/run_block.h"
#include "store/operate/exchange_set.h"
#include "store/vars/run_file.h"

namespace indurop::deploy {

class BoardExchange {
 public:
  // The state is borrowed.
  BoardExchange(const AgentState& state, std::string board) : state_(state), board_(std::move(board)) {}

  enum class Done { Loaded, Entered, Decided };
  struct Answer {
    Done what = Done::Loaded;
    std::string problem;     // empty: it is done
    bool exchanges = false;  // Loaded: the node can change without a restart
  };
  struct Task {
    std::string from;  // ids of the two deployments
    std::string to;
    bool compare = false;    // load nothing for good
    bool node_runs = false;  // and may go on
  };
  // Loads what differs between the two deployments, as soon as an earlier decision is done.
  void load(Task task);
  // Lets the node exchange it in the tick that begins at this time; `alone`: no other board does, so a later one will
  // do.
  void enter(rt::MonoTime at, bool alone);
  // The deployment that is to run from now on: one of the two. A step in progress gets no answer then.
  void decide(const std::string& deployment);
  // Continues; returns the answer to the last call, once.
  std::optional<Answer> poll();
  // The node ends: whatever was prepared is gone.
  void drop();

  // Why the previous versions run again although nothing was decided; empty: they do not.
  [[nodiscard]] std::string returned();
  // Text of a BoardPlan; empty: nothing is planned.
  [[nodiscard]] const std::string& plan() const noexcept { return plan_; }
  void forget_plan() { plan_.clear(); }
  // Multiples of this (ns) are the times at which the node begins ticks that modules are exchanged in; 0: none runs.
  [[nodiscard]] std::int64_t grid_ns() const noexcept { return grid_ns_; }

  // Lets a node that outlived its agent run this deployment again, if it knows it. Waits for that, up to two seconds.
  static void settle(const std::string& board, const AgentState& state);

 private:
  enum class Stage { Idle, Loading, Loaded, Entering, Entered, Deciding };

  void begin_load();
  void request(operate::SetRequest request, Stage stage);
  bool open_run();
  [[nodiscard]] scheduler::RunBlock& run() const noexcept;
  bool place();
  std::optional<Answer> answer_of_node();
  std::optional<Answer> loaded();
  std::optional<Answer> entered();
  std::optional<Answer> decided();
  Answer done(const std::string& problem, bool exchanges = false);
  void describe(const operate::SetReport& report);
  void describe_schedule(const operate::SetReport& report);
  [[nodiscard]] operate::SetReport report_of_node() const;

  const AgentState& state_;
  std::string board_;
  std::optional<vars::RunFile> run_;
  std::optional<operate::ReloadLock> lock_;
  Stage stage_ = Stage::Idle;
  std::optional<operate::SetRequest> request_;  // not yet placed
  std::optional<scheduler::CommandTicket> ticket_;
  bool answers_ = false;  // an answer is due
  std::string early_;     // why nothing was begun
  Task task_;
  bool load_is_due_ = false;
  std::string decided_;
  BoardPlan board_plan_;
  std::string plan_;
  std::int64_t grid_ns_ = 0;
};

}  // namespace indurop::deploy
