// SPDX-License-Identifier: Apache-2.0
// Shared by stop, start and restart: modules of a node of this machine, and modules and nodes of boards anywhere in the
// network.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "scheduler/module_command.h"
#include "tools/cli/command/verb.h"
#include "tools/client/node/module_command.h"

namespace indurop::tools {

struct CommandOptions {
  std::vector<std::string> targets;  // MODULE, MODULE@BOARD, @BOARD
  std::int64_t timeout_ns = 10'000'000'000;
  deploy::LinkSettings link;
};

struct CommandTarget {
  std::string module;  // empty: the node
  std::string board;   // empty: this machine
};

void add_command_options(base::Options& app, Context& context, CommandOptions& options);

// Declares a verb that only takes modules and nodes on its command line; `no_target`: the message if it takes none.
Action declare_command(base::Options& app, Context& context, scheduler::ModuleCommand command, const char* no_target);

// Executes them in the given order and ends at the first failure. Returns the exit code.
int carry_out(Context& context, scheduler::ModuleCommand command, CommandOptions& options);

int command_remote(Context& context, scheduler::ModuleCommand what, const std::vector<CommandTarget>& targets,
                   CommandOptions& options);

}  // namespace indurop::tools
