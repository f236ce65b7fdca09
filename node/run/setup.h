// SPDX-License-Identifier: Apache-2.0
// Derives the settings of the scheduler and the run block from a checked configuration. Pure translation.

#pragma once

#include <vector>

#include "config/check/check.h"
#include "node/run/options.h"
#include "node/run/rights.h"
#include "scheduler/run_block_setup.h"
#include "scheduler/task.h"

namespace indurop::node {

struct Placement {
  int core = 0;          // of modules without a configured core
  bool realtime = true;  // without real-time privileges nothing is pinned
};

// Where the modules of a node with these rights run.
Placement placement(const Options& options, const Rights& rights);

scheduler::RunBlockSetup make_run_setup(const config::Config& config, const config::CheckResult& check,
                                        const std::string& node, const Placement& placement);

// One task per periodic and sporadic module; run and condition of thread modules are left empty.
std::vector<scheduler::Task> make_tasks(const config::Config& config, const config::CheckResult& check,
                                        const scheduler::RunBlockSetup& setup, int default_core);
// Replaces the indices of modules by others: `indices`, by module.
void renumber(std::vector<scheduler::Task>& tasks, const std::vector<std::uint32_t>& indices);
// Lets the periods of all modules begin so much later, as far as their own periods go.
void delay_periods(std::vector<scheduler::Task>& tasks, scheduler::RunBlockSetup& setup, std::int64_t delay_ns);

// In a simulation each run takes the time of <wcet>, else that of `times`, else no time.
void set_work_times(std::vector<scheduler::Task>& tasks, const config::Config& config,
                    const config::CheckOptions::Times& times);

}  // namespace indurop::node
