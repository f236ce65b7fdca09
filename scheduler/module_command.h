// SPDX-License-Identifier: Apache-2.0
// Commands to a running node about one of its modules, through the module's record in the run block: whoever may write
// the block places one, the node carries it out beside the schedule and answers. No files here.

#pragma once

#include <cstdint>
#include <optional>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

enum class ModuleCommand : std::uint8_t { None, Stop, Start, Restart };
enum class CommandResult : std::uint8_t {
  None,       // not answered yet
  Done,       // the module is as it was commanded to be
  Unchanged,  // it was so before
  Failed,     // it is not; ModuleRecord::last_fault or the node's own words tell why
  Ending,     // the node itself stops
  OldCode,    // done, but its file is another one now than the one that was loaded and runs
};

// What a ticket stands for; the next command gets another one.
using CommandTicket = std::uint64_t;

// Nothing while an earlier command of the module is not answered yet. Any process, any thread.
std::optional<CommandTicket> place_command(ModuleRecord& record, ModuleCommand command) noexcept;
// None while the node is at it. Of a command that was followed by another one only Done is known.
CommandResult result_of(const ModuleRecord& record, CommandTicket ticket) noexcept;

// For the node: the command that waits for an answer, and the answer.
ModuleCommand waiting_command(const ModuleRecord& record) noexcept;
void answer_command(ModuleRecord& record, CommandResult result) noexcept;

}  // namespace indurop::scheduler
