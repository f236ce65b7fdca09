// SPDX-License-Identifier: Apache-2.0
// Says whether a module is working, also in words for users.

#pragma once

#include "scheduler/run_block.h"

namespace indurop::scheduler {

// Returns "is stopped", "is out of service", "is waiting for its restart" or "has not started yet"; null if the module
// is working or has finished its work. Thread and real-time safe.
const char* down_text(ModuleState state) noexcept;
// Returns true if the module runs, or, in the background, has done its work.
inline bool is_up(ModuleState state) noexcept {
  return state == ModuleState::Running || state == ModuleState::Exited;
}
// Returns true if the module is down because of its last fault.
inline bool is_down_by_fault(ModuleState state) noexcept {
  return state == ModuleState::Faulted || state == ModuleState::Restarting;
}

}  // namespace indurop::scheduler
