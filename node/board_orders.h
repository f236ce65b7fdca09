// SPDX-License-Identifier: Apache-2.0
// Orders from afar to this board's node and its modules: who may give them, carrying them out one at a time, and the
// answers. The agent's business, beside deployments and never during one.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "mirror/command_link.h"
#include "node/board_process.h"
#include "node/deploy_keys.h"
#include "scheduler/module_order.h"
#include "vars/run_file.h"

namespace indurop::node {

class BoardOrders {
 public:
  BoardOrders(std::string board, std::uint64_t self, const DeployKeys& keys, BoardProcess& process, Console& console);

  // Takes what has come and goes on with the order under way. `plant`: what is committed here; `busy`: why no order is
  // taken now, empty: it is.
  void step(mirror::CommandLink& link, const std::string& plant, const std::string& busy, std::int64_t now_ns);

 private:
  struct Known {
    std::uint64_t nonce = 0;
    std::int64_t given_ns = 0;
    std::optional<deploy::CommandReply> last;  // to the order with this number
  };
  void hear(mirror::CommandLink& link, const deploy::Command& command, const std::string& plant,
            const std::string& busy, std::int64_t now_ns);
  deploy::CommandReply begin(const deploy::Command& command, const std::string& plant, const std::string& busy,
                             std::int64_t now_ns);
  deploy::CommandReply begin_module(const deploy::Command& command);
  deploy::CommandReply begin_node(const deploy::Command& command);
  // Empty while it goes on.
  std::optional<deploy::CommandReply> look(std::int64_t now_ns);
  std::optional<deploy::CommandReply> look_at_module();
  std::optional<deploy::CommandReply> look_at_node();
  bool open_run(std::string& problem);
  scheduler::ModuleRecord* find(const std::string& module);
  [[nodiscard]] deploy::CommandReply reply(const deploy::Command& command, deploy::Outcome outcome,
                                           const std::string& text = {}) const;

  std::string board_;
  std::uint64_t self_;
  const DeployKeys& keys_;
  BoardProcess& process_;
  Console& console_;
  std::map<std::uint64_t, Known> known_;    // by commander
  std::optional<deploy::Command> command_;  // under way
  std::int64_t deadline_ns_ = 0;
  std::optional<vars::RunFile> run_;
  scheduler::ModuleRecord* module_ = nullptr;
  scheduler::OrderTicket ticket_ = 0;
  bool ended_ = false;  // a node that restarts has done the first half
};

}  // namespace indurop::node
