// SPDX-License-Identifier: Apache-2.0
// Whether a module does its work, in the words that people read.

#pragma once

#include "scheduler/run_block.h"

namespace indurop::scheduler {

// "is stopped", "is out of service", "is waiting for its restart", "has not started yet"; null: it does its work, or
// was done with it. Thread and real-time safe.
const char* down_text(ModuleState state) noexcept;
// It is down because of its last fault.
inline bool is_down_by_fault(ModuleState state) noexcept {
  return state == ModuleState::Faulted || state == ModuleState::Restarting;
}

}  // namespace indurop::scheduler
