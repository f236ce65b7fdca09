// SPDX-License-Identifier: Apache-2.0
// The privileges that the machine grants the node for real time: a core, FIFO priorities, short idle states, locked
// memory. Without them the node runs as well as it can and reports that, or ends (--require-rt).

#pragma once

#include <vector>

#include "config/model/config.h"
#include "core/rt/machine.h"
#include "node/run/console.h"
#include "node/run/ending.h"
#include "node/run/options.h"
#include "scheduler/run_block.h"

namespace indurop::node {

struct Rights {
  rt::ShortIdle idle;
  scheduler::Obtained obtained{};
  int core = 0;  // of the tick and of all modules without a configured core
  [[nodiscard]] bool realtime() const noexcept { return obtained.fifo != 0; }
};

Result<Rights, Ending> obtain_rights(const Options& options, const config::Config& config, const Console& console);

// A simulation needs no privileges: only the core for modules without a configured core is set.
Rights simulated_rights(const Options& options, const config::Config& config);

// Locks the memory, so that no page is loaded on demand; reports in `run` whether that worked. Call it late, after
// memory that is no longer needed has been freed.
Result<void, Ending> lock_memory(const Options& options, const Rights& rights, scheduler::RunBlock& run,
                                 const Console& console);

// Returns an empty list if modules are on each core.
std::vector<int> cores_without_modules(const config::Config& config, const Rights& rights);

// The command line takes precedence over the file.
config::SpinSetting spin_setting(const Options& options, const config::Config& config);

}  // namespace indurop::node
