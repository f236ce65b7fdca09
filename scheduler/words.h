// SPDX-License-Identifier: Apache-2.0
// The text for the states and kinds of a run that users read and write: one table for every program.

#pragma once

#include "scheduler/run_block.h"

namespace indurop::scheduler {

// Returns "unknown" for any other value: it may come from a damaged file. Thread and real-time safe.
const char* to_text(NodeState state) noexcept;
const char* to_text(ModuleType type) noexcept;
const char* to_text(Operation operation) noexcept;
const char* to_text(ModuleState state) noexcept;
const char* to_text(FaultKind kind) noexcept;

}  // namespace indurop::scheduler
