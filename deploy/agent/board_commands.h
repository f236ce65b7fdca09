// SPDX-License-Identifier: Apache-2.0
// Remote commands to this board's node, its modules and variables: checks who may give them, executes them one at a
// time, and answers. The agent does this in addition to deployments and never during one.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/note_limit.h"
#include "core/rt/clock.h"
#include "deploy/agent/board_forces.h"
#include "deploy/agent/board_process.h"
#include "deploy/agent/board_recorder.h"
#include "deploy/agent/board_reload.h"
#include "deploy/agent/board_users.h"
#include "deploy/agent/deploy_keys.h"
#include "deploy/agent/node_command.h"
#include "deploy/link/command_link.h"
#include "deploy/transaction/write_words.h"
#include "scheduler/module_command.h"
#include "store/vars/run_file.h"

namespace indurop::deploy {

class BoardCommands {
 public:
  BoardCommands(std::string board, std::uint64_t self, const DeployKeys& keys, AgentState& state, BoardProcess& process,
                BoardRecorder& recorder, const base::Log& log);

  // Receives new commands and continues the one under way. `plant`: what is committed on this board; `busy`: why no
  // command is accepted now, empty: commands are accepted. Returns true if a command was received.
  // `files`: new versions of modules come over it.
  bool step(CommandLink& link, DeployLink& files, const std::string& plant, const std::string& busy, rt::MonoTime now);
  [[nodiscard]] const BoardUsers& users() const noexcept { return users_; }

 private:
  struct Known {
    std::uint64_t nonce = 0;
    rt::MonoTime given;
    std::optional<deploy::CommandReply> last;  // last reply to the command with this number
  };
  void receive(CommandLink& link, const Command& command, const std::string& plant, const std::string& busy,
               rt::MonoTime now);
  CommandReply begin(Command command, const std::string& plant, const std::string& busy, rt::MonoTime now);
  CommandReply carry_out(const Command& command, const std::string& plant, const BoardUsers::Verdict& verdict,
                         const std::string& busy, rt::MonoTime now);
  CommandReply refuse(const Command& command, const std::string& user, const std::string& why, rt::MonoTime now);
  CommandReply take_trust(const Command& command, const std::string& plant, rt::MonoTime now);
  CommandReply begin_module(const Command& command, const WriteOrder& words, rt::MonoTime now);
  CommandReply begin_reload(const Command& command, const WriteOrder& words, rt::MonoTime now);
  CommandReply begin_node(const Command& command, const WriteOrder& words);
  void send_reply(const CommandReply& done) const;
  CommandReply perform(const Command& command, const std::string& user, const WriteOrder& words, rt::MonoTime now);
  CommandReply write(const Command& command, const std::string& user);
  [[nodiscard]] CommandReply keep_box(const Command& command) const;
  [[nodiscard]] CommandReply about_alarms(const Command& command) const;
  CommandReply begin_recording(const Command& command, rt::MonoTime now);
  // Returns the reply; empty while the command is under way.
  std::optional<deploy::CommandReply> poll(DeployLink& files, rt::MonoTime now);
  std::optional<deploy::CommandReply> poll_module();
  std::optional<deploy::CommandReply> poll_node();
  std::optional<deploy::CommandReply> poll_recording();
  std::optional<deploy::CommandReply> poll_reload(DeployLink& files, rt::MonoTime now);
  bool open_run();  // false: the node is not running
  scheduler::ModuleRecord* find(const std::string& module);
  [[nodiscard]] CommandReply reply(const Command& command, Outcome outcome, const std::string& text = {}) const;

  std::string board_;
  BoardForces forces_;
  std::uint64_t self_;
  const DeployKeys& keys_;
  BoardUsers users_;
  BoardProcess& process_;
  NodeCommand node_;
  BoardRecorder& recorder_;
  BoardReload reload_;
  const base::Log& log_;
  base::NoteLimit refusals_;                // a flood of refused commands pushes no entry out of the audit log
  std::map<std::uint64_t, Known> known_;    // by commander
  std::optional<deploy::Command> command_;  // under way
  WriteOrder words_;                        // its user, reason and module
  std::string user_;                        // verified; empty: a deployer
  rt::MonoTime deadline_;
  std::optional<vars::RunFile> run_;
  scheduler::ModuleRecord* module_ = nullptr;
  scheduler::CommandTicket ticket_ = 0;
};

}  // namespace indurop::deploy
