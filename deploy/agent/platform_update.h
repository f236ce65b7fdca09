// SPDX-License-Identifier: Apache-2.0
// The platform of a board is updated as its plant is, by the same messages and the same state machine: this part of the
// agent fetches a release, checks it, ends the node and leaves the switch to the launcher; its successor, which is the
// agent of the new release, goes on from there until the release is committed or the board goes back (ADR 38).

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/rt/clock.h"
#include "deploy/agent/agent_state.h"
#include "deploy/agent/board_process.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/agent/fetcher.h"
#include "deploy/agent/platform_launcher.h"
#include "deploy/agent/report_schedule.h"
#include "deploy/disk/last_switch.h"
#include "deploy/link/blob_server.h"
#include "deploy/link/deploy_link.h"
#include "deploy/transaction/board_transaction.h"

namespace indurop::deploy {

// Returns the session number that an agent continues after a switch; 0: its own.
std::uint64_t continued_session(const AgentState& platform);

class PlatformUpdate {
 public:
  static constexpr std::chrono::seconds kAliveAfter{10};  // then a start counts as one that went well

  PlatformUpdate(std::string board, std::uint64_t self, const RunningRelease& running, AgentState& state,
                 const DeployKeys& keys, BoardProcess& process, const base::Log& log);

  // What else the board does: `plant`: what is committed on it; `idle`: no deployment is under way.
  void step(DeployLink* link, const CommittedDeployment& plant, bool idle, rt::MonoTime now);

  // Returns true while the release is being changed; deployments and commands have to wait.
  [[nodiscard]] bool under_way() const noexcept { return transaction_.phase() != Phase::Steady || leaving_; }
  // Returns true when this process has to become another program: the caller leaves the network and calls leave().
  [[nodiscard]] bool leaves() const noexcept { return leaving_ && !process_.has_node(); }
  // Becomes the launcher. Returns only after a failure; the board continues with this release then.
  void leave();
  // Version of the release that runs.
  [[nodiscard]] std::string version() const { return version_of(running_.id); }

 private:
  void listen(DeployLink& link, bool idle, rt::MonoTime now);
  [[nodiscard]] std::string refusal_of(const Order& order, bool idle) const;
  bool may_order(const Order& order, bool idle);
  [[nodiscard]] std::uint64_t generation() const;
  [[nodiscard]] bool lacks(const BoardReport& other) const;
  void work(DeployLink& link, rt::MonoTime now);
  void follow(rt::MonoTime now);
  void perform(BoardTransaction::Do what, rt::MonoTime now);
  [[nodiscard]] std::vector<std::uint64_t> sources_of(const std::string& id) const;
  [[nodiscard]] std::string check() const;
  void prepare_switch();
  void commit(const Order& order);
  void go_back(const Order& order);
  void note_alive(rt::MonoTime now);
  std::string note_switch();  // returns why it failed; empty: it is noted
  [[nodiscard]] BoardReport report() const;
  [[nodiscard]] std::string message() const;
  [[nodiscard]] std::string version_of(const std::string& id) const;
  [[nodiscard]] std::string title_of(const std::string& id) const;

  std::string board_;
  std::uint64_t self_;
  std::string host_;
  RunningRelease running_;
  AgentState& state_;
  const DeployKeys& keys_;
  BoardProcess& process_;
  const base::Log& log_;
  BoardTransaction transaction_;
  Fetcher fetcher_;
  BlobServer server_;
  ReportSchedule schedule_;
  std::string keys_plant_;  // the plant of the board's keys at the agent's start; empty: none
  std::optional<LastSwitch> last_;
  CommittedDeployment plant_;                 // as step() got it last
  std::map<std::string, BoardReport> peers_;  // by board, this one included
  std::uint64_t refused_ = 0;                 // deployer of the order that was rejected last
  std::string refusal_;
  bool leaving_ = false;   // the node ends, then this process becomes another program
  bool released_ = false;  // the agent of this release has done what the kernel waits for, and its start is forgotten
  std::chrono::nanoseconds stood_{};  // how long the node stood for the switch; 0: not known
  rt::MonoTime begun_;
};

}  // namespace indurop::deploy
