// SPDX-License-Identifier: Apache-2.0
// Writes what modules keep at the end of a replay, for programs that step through a recording.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <functional>

#include "core/base/problem.h"
#include "node/replay/comparison.h"
#include "node/replay/replayed_modules.h"

namespace indurop::node {

// Writes JSON (docs/recording.md) to `file`. Called before the modules are stopped. `memory_of`: what a module keeps;
// null: that cannot be taken. Errors: those of the disk.
Result<void, base::Problem> write_kept(const std::filesystem::path& file, std::uint64_t tick,
                                       const ReplayedModules& modules, const Comparison& comparison,
                                       const std::function<const ModuleMemory*(const ReplayedModule&)>& memory_of);

}  // namespace indurop::node
