// SPDX-License-Identifier: Apache-2.0
// A command to a module of a node of this machine, through its run block.

#pragma once

#include <cstdint>
#include <string>

#include "scheduler/module_command.h"
#include "store/operate/who.h"
#include "tools/client/failure.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {

struct Commanded {
  scheduler::CommandResult result = scheduler::CommandResult::None;  // Done, OldCode or Unchanged
  std::int64_t took_ns = 0;
  std::string text;  // "module 'x' stopped after 3 ms"
};

// What a node answered to a command.
struct CommandAnswer {
  RunView run;
  const scheduler::ModuleRecord* record = nullptr;  // in `run`
  scheduler::CommandResult result = scheduler::CommandResult::None;
  std::int64_t took_ns = 0;
};
// Returns the index of a module. Errors: the node has none of this name; the text has the nearest one.
Result<std::uint32_t, Failure> find_module(const RunView& run, const std::string& node, const std::string& module);

// Waits until the node has answered, at most `timeout_ns`.
Result<CommandAnswer, Failure> await_answer(const std::string& node, scheduler::ModuleCommand command,
                                            const std::string& module, std::int64_t timeout_ns);
// Notes a command in the node's journal.
void note_command(const std::string& node, const RunView& run, scheduler::ModuleCommand command,
                  const std::string& module, const std::string& value, const operate::Who& who);

// Waits until the node has answered, at most `timeout_ns`, and notes user and reason in the node's journal.
Result<Commanded, Failure> command_module(const std::string& node, scheduler::ModuleCommand command,
                                          const std::string& module, std::int64_t timeout_ns, const operate::Who& who);

const char* verb_of(scheduler::ModuleCommand command);  // "stop"
const char* past_of(scheduler::ModuleCommand command);  // "stopped"

}  // namespace indurop::tools
