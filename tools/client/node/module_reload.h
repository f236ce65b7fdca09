// SPDX-License-Identifier: Apache-2.0
// Exchanges the code of a module of a running node of this machine.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/operate/reload.h"
#include "tools/client/node/module_command.h"

namespace indurop::tools {

struct Reloaded {
  std::string node;
  CommandAnswer answer;
  operate::ReloadReport report;
};

// Waits until no other process commands an exchange, at most `timeout_ns`.
Result<operate::ReloadLock, Failure> lock_when_free(const std::string& node, std::int64_t timeout_ns);

// Commands it and waits until the node has answered, at most `timeout_ns`; user and reason go to the node's journal.
// `command`: Reload, or Back to the previous version.
Result<Reloaded, Failure> reload_module(const std::string& node, scheduler::ModuleCommand command,
                                        const std::string& module, const operate::ReloadRequest& request,
                                        std::int64_t timeout_ns, const operate::Who& who);

// The version of a module in words: "version 2 (1f3a5b7c9d0e) since tick 4711, watched"; empty if it was never
// exchanged.
std::string version_text(const scheduler::ModuleRecord& module);

}  // namespace indurop::tools
