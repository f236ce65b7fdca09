// SPDX-License-Identifier: Apache-2.0
// The run block of a board's node while it runs, for commands to its modules.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>

#include "scheduler/run_block.h"
#include "store/vars/run_file.h"

namespace indurop::deploy {

// Returns nothing if no node of this release runs on the board, or if its run block is invalid.
std::optional<vars::RunFile> open_running_node(const std::string& board);
scheduler::RunBlock& run_block(const vars::RunFile& file) noexcept;
// Returns null if there is no such module.
scheduler::ModuleRecord* find_module_record(scheduler::RunBlock& run, const std::string& name);
// Says why a request to the node was not written.
std::string describe_unwritten(const Error& error);

}  // namespace indurop::deploy
