// SPDX-License-Identifier: Apache-2.0
#include "node/run/setup.h"

#include <algorithm>
#include <utility>

namespace indurop::node {
namespace {

using scheduler::Operation;

// A module that never returns is a fault even without a configured budget.
constexpr int kDefaultBudgetPeriods = 10;
constexpr base::Nanos kSmallestDefaultBudget = std::chrono::milliseconds(5);
constexpr base::Nanos kSporadicBudget = std::chrono::seconds(1);

base::Nanos budget_of(const config::Module& module) {
  if (module.budget == config::kNoBudget) {
    return {};
  }
  if (module.budget.count() > 0) {
    return module.budget;
  }
  return module.operation == Operation::Periodic
             ? std::max(module.period * kDefaultBudgetPeriods, kSmallestDefaultBudget)
             : kSporadicBudget;
}

scheduler::ModuleSetup module_setup(const config::Module& module, const Placement& placement) {
  scheduler::ModuleSetup setup;
  setup.name = module.name;
  setup.file = module.file.string();
  setup.type = module.type;
  setup.operation = module.operation;
  setup.overrun = module.overrun;
  setup.priority = module.priority;
  setup.period_ns = module.period.count();
  setup.offset_ns = module.offset.count();
  if (module.operation != Operation::NonReal) {
    const bool no_deadline = module.deadline.count() == 0;
    setup.deadline_ns = (no_deadline ? module.period : module.deadline).count();
    setup.budget_ns = budget_of(module).count();
    setup.core = !placement.realtime ? -1 : module.core >= 0 ? module.core : placement.core;
  } else {
    setup.core = module.core;
  }
  for (const config::Property& property : module.properties) {
    setup.properties.emplace_back(property.name, property.value);
  }
  return setup;
}

}  // namespace

Placement placement(const Options& options, const Rights& rights) {
  return {rights.core, rights.realtime() || options.simulation.on};
}

scheduler::RunBlockSetup make_run_setup(const config::Config& config, const config::CheckResult& check,
                                        const std::string& node, const Placement& placement) {
  // Without periodic modules the event handler still needs a period.
  constexpr base::Nanos kIdlePeriod = std::chrono::milliseconds(1);
  scheduler::RunBlockSetup setup;
  setup.node_name = node;
  setup.config_file = std::filesystem::absolute(config.file).string();
  const bool empty = check.periodic.empty();
  setup.basic_period_ns = (empty ? kIdlePeriod : check.table.basic_period).count();
  setup.macro_period_ns = (empty ? kIdlePeriod : check.table.macro_period).count();
  setup.slot_count = static_cast<std::uint64_t>(setup.macro_period_ns / setup.basic_period_ns);
  for (const config::Module& module : config.modules) {
    setup.modules.push_back(module_setup(module, placement));
  }
  return setup;
}

std::vector<scheduler::Task> make_tasks(const config::Config& config, const config::CheckResult& check,
                                        const scheduler::RunBlockSetup& setup, int default_core) {
  std::vector<std::vector<std::uint32_t>> after(config.modules.size());
  for (const config::Sharing& sharing : check.sharing) {
    after[sharing.second].push_back(static_cast<std::uint32_t>(sharing.first));
  }
  std::vector<scheduler::Task> tasks;
  for (std::uint32_t i = 0; i < config.modules.size(); ++i) {
    const config::Module& module = config.modules[i];
    if (module.operation == Operation::NonReal) {
      continue;
    }
    scheduler::Task task;
    task.index = i;
    task.type = module.type;
    task.operation = module.operation;
    task.overrun = module.overrun;
    task.priority = module.priority;
    task.core = module.core >= 0 ? module.core : default_core;
    task.period_ns = module.period.count();
    task.offset_ns = module.offset.count();
    task.budget_ns = setup.modules[i].budget_ns;
    task.after_base = module.after_base;
    task.legacy_signal = module.signal;
    task.after = std::move(after[i]);
    tasks.push_back(task);
  }
  return tasks;
}

void renumber(std::vector<scheduler::Task>& tasks, const std::vector<std::uint32_t>& indices) {
  for (scheduler::Task& task : tasks) {
    task.index = indices[task.index];
    for (std::uint32_t& before : task.after) {
      before = indices[before];
    }
  }
}

void delay_periods(std::vector<scheduler::Task>& tasks, scheduler::RunBlockSetup& setup, std::int64_t delay_ns) {
  for (scheduler::Task& task : tasks) {
    scheduler::ModuleSetup& module = setup.modules[task.index];
    if (task.operation == Operation::Periodic && task.period_ns > 0) {
      task.offset_ns = module.offset_ns = (task.offset_ns + delay_ns) % task.period_ns;
    }
  }
}

void set_work_times(std::vector<scheduler::Task>& tasks, const config::Config& config,
                    const config::CheckOptions::Times& times) {
  for (scheduler::Task& task : tasks) {
    const config::Module& module = config.modules[task.index];
    const auto measured = times.find(module.name);
    task.work_ns = module.wcet.count() > 0   ? module.wcet.count()
                   : measured != times.end() ? measured->second.count()
                                             : 0;
  }
}

}  // namespace indurop::node
