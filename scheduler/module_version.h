// SPDX-License-Identifier: Apache-2.0
// The version of a module's code in its record.

#pragma once

#include <string>
#include <string_view>

#include "core/rt/copy_text.h"
#include "core/rt/fixed_text.h"
#include "scheduler/run_block.h"

namespace indurop::scheduler {

// Another version of its code runs from this tick on, from a file with this SHA-256. Readers see the number last. One
// normal thread of the node.
inline void set_version(ModuleRecord& module, std::string_view digest, std::uint64_t tick,
                        VersionState state) noexcept {
  const std::uint64_t number = module.version.load() + 1;
  rt::copy_text(module.digests[number % 2], digest);
  module.version_tick.store(tick);
  module.version_state.store(state);
  module.version.store(number, std::memory_order_release);
}

// SHA-256 of the file that runs; empty: it is not known.
inline std::string running_digest(const ModuleRecord& module) {
  const std::uint64_t number = module.version.load(std::memory_order_acquire);
  return number == 0 ? std::string() : std::string(rt::text_of(module.digests[number % 2]));
}

}  // namespace indurop::scheduler
