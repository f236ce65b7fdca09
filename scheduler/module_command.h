// SPDX-License-Identifier: Apache-2.0
// Commands to a running node about one of its modules, through the module's record in the run block: a process that may
// write the block places one, the node executes it in the background and answers. No files are used.

#pragma once

#include <cstdint>
#include <optional>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

enum class ModuleCommand : std::uint8_t {
  None,
  Stop,
  Start,
  Restart,
  Reload,  // exchange its code; a request in the node's folder says with what (store/operate/reload.h)
  Back,    // exchange its code with the previous version
  // Exchange several modules; it is placed at the first module of the node, and a request in the node's folder says
  // what (store/operate/exchange_set.h).
  Exchange,
  // Another schedule, in the same way (store/operate/schedule_request.h).
  Schedule,
};
enum class CommandResult : std::uint8_t {
  None,       // not answered yet
  Done,       // the module is in the commanded state
  Unchanged,  // it was in that state before
  Failed,     // it is not; ModuleRecord::last_fault or the node's log says why
  Ending,     // the node itself stops
  OldCode,    // done, but the module's file is no longer the one that was loaded and runs
  Refused,    // nothing was changed; the report of a reload says why
};

// Identifies one command; the next command gets another ticket.
using CommandTicket = std::uint64_t;

// Returns nothing while an earlier command of the module has no answer yet. Any process, any thread.
std::optional<CommandTicket> place_command(ModuleRecord& record, ModuleCommand command) noexcept;
// Returns None while the node executes the command. For a command that was followed by another one only Done is known.
CommandResult result_of(const ModuleRecord& record, CommandTicket ticket) noexcept;

// For the node: the command waiting for an answer, and the answer.
ModuleCommand waiting_command(const ModuleRecord& record) noexcept;
void answer_command(ModuleRecord& record, CommandResult result) noexcept;

}  // namespace indurop::scheduler
