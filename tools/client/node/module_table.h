// SPDX-License-Identifier: Apache-2.0
// The modules of a run with their counters and times, for `status`.

#pragma once

#include <string>

#include "tools/client/node/run_view.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

// `alive`: the node runs; else the states are the last known ones.
Table module_table(const RunView& run, bool alive);
// Returns "SIGSEGV at address 0x0 (tick 12)"; empty: no fault.
std::string fault_text(const scheduler::ModuleRecord& module);

}  // namespace indurop::tools
