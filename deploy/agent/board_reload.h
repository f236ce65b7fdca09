// SPDX-License-Identifier: Apache-2.0
// Exchanges the code of one module of this board's node by command: fetches the new file from the client, lets the node
// exchange it, and waits until the new version has settled or the previous one runs again.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/rt/clock.h"
#include "deploy/agent/agent_state.h"
#include "deploy/agent/fetcher.h"
#include "deploy/words/command_words.h"
#include "scheduler/module_command.h"
#include "scheduler/run_block.h"
#include "store/operate/remote_reload.h"

namespace indurop::deploy {

class BoardReload {
 public:
  // The state is borrowed: the file is kept there, among those of deployments, until garbage is collected.
  BoardReload(AgentState& state, std::uint64_t self, std::string board)
      : board_(board), state_(state), fetcher_(state, self, std::move(board)) {}

  // `order`: text of an operate::RemoteReload. `module` is borrowed until poll() has answered. Returns why it is
  // refused; empty: it is under way, for at most patience().
  std::string begin(std::uint64_t commander, const std::string& order, scheduler::ModuleRecord& module);
  [[nodiscard]] std::chrono::nanoseconds patience() const noexcept;

  struct Answer {
    Outcome outcome = Outcome::Failed;
    std::string text;  // Done: of an operate::RemoteReloadReply; else why
  };
  // Continues it; the answer, when it is done.
  std::optional<Answer> poll(DeployLink& link, rt::MonoTime now);
  // Ends it: what the node has begun, it ends on its own.
  void cancel();

 private:
  std::optional<Answer> place();
  std::optional<Answer> answer_of_node();
  std::optional<Answer> settled();
  Answer report(operate::RemoteReloadReply::Result result);

  std::string board_;
  AgentState& state_;
  Fetcher fetcher_;
  operate::RemoteReload order_;
  std::optional<operate::ReloadLock> lock_;
  scheduler::ModuleRecord* module_ = nullptr;
  std::optional<scheduler::CommandTicket> ticket_;
  bool exchanged_ = false;  // it is in its health window
};

}  // namespace indurop::deploy
