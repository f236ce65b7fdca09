// SPDX-License-Identifier: Apache-2.0
// What the node gets of the machine for real time: a core, FIFO priorities, short idle states, locked memory. Without
// rights it runs as well as it can and says so, or ends (--require-rt).

#pragma once

#include <vector>

#include "config/model/config.h"
#include "node/console.h"
#include "node/ending.h"
#include "node/options.h"
#include "rt/machine.h"
#include "scheduler/run_block.h"

namespace indurop::node {

struct Rights {
  rt::ShortIdle idle;
  scheduler::Obtained obtained{};
  int core = 0;  // of the tick and of all modules that name none
  [[nodiscard]] bool realtime() const noexcept { return obtained.fifo != 0; }
};

Result<Rights, Ending> obtain_rights(const Options& options, const config::Config& config, const Console& console);

// A simulation needs none: only the core that modules are on which name none.
Rights simulated_rights(const Options& options, const config::Config& config);

// Memory does not come page by page any more; says in `run` whether that worked. To be called late: what is needed no
// longer is to be gone.
Result<void, Ending> lock_memory(const Options& options, const Rights& rights, scheduler::RunBlock& run,
                                 const Console& console);

// Empty if modules are on each.
std::vector<int> cores_without_modules(const config::Config& config, const Rights& rights);

// The command line's word counts more than the file's.
config::SpinSetting spin_setting(const Options& options, const config::Config& config);

}  // namespace indurop::node
