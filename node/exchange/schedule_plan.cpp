// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/schedule_plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/duration.h"
#include "core/keys/digest.h"
#include "scheduler/module_version.h"

namespace indurop::node {
namespace {

using config::Config;
using config::Module;
using scheduler::ModuleType;
using scheduler::Operation;

// A module without what a schedule may change, and without what depends on the place of its text or its file.
Module without_schedule(Module module) {
  module.period = {};
  module.offset = {};
  module.deadline = {};
  module.wcet = {};
  module.budget = {};
  module.priority = 0;
  module.overrun = {};
  module.after.clear();
  module.file.clear();
  module.file_as_written.clear();
  module.place = {};
  module.places = {};
  for (config::FailSafe& value : module.failsafe) {
    value.place = {};
  }
  for (config::Property& property : module.properties) {
    property.place = {};
  }
  return module;
}

// A configuration without its modules.
Config without_modules(Config config) {
  config.modules.clear();
  config.file.clear();
  config.minimum_period = {};
  config.core_place = {};
  config.spin_place = {};
  if (config.cores) {
    config.cores->place = {};
    config.cores->times.clear();  // modules are on their cores already
  }
  config.external.type_places.clear();
  for (config::VariableRule& rule : config.external.variables) {
    rule.place = {};
    rule.owner_place = {};
  }
  return config;
}

// Returns the name of the element in which two modules differ, apart from their schedule.
std::string other_difference(const Module& before, const Module& after) {
  const std::pair<bool, const char*> elements[] = {{before.type != after.type, "<moduletype>"},
                                                   {before.operation != after.operation, "<operationtype>"},
                                                   {before.core != after.core, "<core>"},
                                                   {before.properties != after.properties, "<property>"},
                                                   {before.failsafe != after.failsafe, "<failsafe>"},
                                                   {before.arguments != after.arguments, "<argument>"},
                                                   {before.after_base != after.after_base, "<position>"}};
  for (const auto& [differs, name] : elements) {
    if (differs) {
      return name;
    }
  }
  return "what is neither period, offset, deadline, budget, priority nor overrun policy";
}

const char* policy_text(scheduler::OverrunPolicy policy) noexcept {
  switch (policy) {
    case scheduler::OverrunPolicy::Skip:
      return "skip";
    case scheduler::OverrunPolicy::CatchUp:
      return "catch-up";
    case scheduler::OverrunPolicy::StopModule:
      return "stop-module";
    case scheduler::OverrunPolicy::StopNode:
      return "stop-node";
  }
  return "";
}

std::string time_text(base::Nanos time) {
  return time == config::kNoBudget ? "off" : time.count() == 0 ? "default" : base::format_duration(time);
}

// Returns "period 2 ms -> 4 ms, priority 1 -> 3".
std::string schedule_difference(const Module& before, const Module& after) {
  std::vector<std::string> parts;
  const auto add = [&parts](const char* what, const auto& was, const auto& is) {
    if (was != is) {
      parts.push_back(fmt::format("{} {} -> {}", what, was, is));
    }
  };
  add("period", base::format_duration(before.period), base::format_duration(after.period));
  add("offset", base::format_duration(before.offset), base::format_duration(after.offset));
  add("priority", before.priority, after.priority);
  add("deadline", time_text(before.deadline), time_text(after.deadline));
  add("budget", time_text(before.budget), time_text(after.budget));
  add("overrun", std::string(policy_text(before.overrun)), std::string(policy_text(after.overrun)));
  add("after", fmt::format("({})", fmt::join(before.after, ", ")), fmt::format("({})", fmt::join(after.after, ", ")));
  return fmt::format("{}", fmt::join(parts, ", "));
}

class ScheduleComparison {
 public:
  ScheduleComparison(const Config& running, const scheduler::RunBlock& run)
      : running_(running), run_(run), simulated_(run.virtual_ns.load() != 0) {}

  SchedulePlan run(const Config& next, const config::CheckResult& check) {
    for (const Module& module : next.modules) {
      add(module);
    }
    if (const std::uint32_t room = run_.module_capacity - run_.module_count; new_ > room) {
      restart(fmt::format("{} modules are new, and there is room for {}", new_, room));
    }
    for (std::uint32_t i = 0; i < running_.modules.size(); ++i) {
      const bool goes_on = std::find(plan_.indices.begin(), plan_.indices.end(), i) != plan_.indices.end();
      if (!goes_on && !run_.modules()[i].ended) {
        plan_.modules.push_back({running_.modules[i].name, ModuleFate::Kind::Ended, ""});
        plan_.ended.push_back(i);
      }
    }
    compare_rest(next);
    compare_grid(check);
    plan_.changes = !std::is_sorted(plan_.indices.begin(), plan_.indices.end()) ||
                    std::any_of(plan_.modules.begin(), plan_.modules.end(),
                                [](const ModuleFate& fate) { return fate.kind != ModuleFate::Kind::Kept; });
    return std::move(plan_);
  }

 private:
  void restart(std::string why) { plan_.restarts.push_back(std::move(why)); }

  void add(const Module& module) {
    const auto found = std::find_if(running_.modules.begin(), running_.modules.end(),
                                    [&module](const Module& one) { return one.name == module.name; });
    if (found == running_.modules.end()) {
      plan_.modules.push_back({module.name, ModuleFate::Kind::Added, ""});
      plan_.indices.push_back(SchedulePlan::kNoModule);
      ++new_;
      add_arrival(module);
      return;
    }
    const auto index = static_cast<std::uint32_t>(found - running_.modules.begin());
    plan_.indices.push_back(index);
    const std::string text = schedule_difference(*found, module);
    const bool returns = run_.modules()[index].ended;
    plan_.modules.push_back({module.name,
                             returns        ? ModuleFate::Kind::Added
                             : text.empty() ? ModuleFate::Kind::Kept
                                            : ModuleFate::Kind::Rescheduled,
                             text});
    if (without_schedule(*found) != without_schedule(module)) {
      restart(fmt::format("module {} differs in {}", module.name, other_difference(*found, module)));
    } else if (module.operation == Operation::NonReal && !text.empty()) {
      restart(fmt::format("module {} runs in the background, in no schedule", module.name));
    } else if (returns) {
      add_arrival(module);
    }
  }

  void add_arrival(const Module& module) {
    plan_.added.push_back(static_cast<std::uint32_t>(plan_.indices.size() - 1));
    if (module.type == ModuleType::Process && simulated_) {
      restart(fmt::format("module {} is a process, and a simulation has only those it began with", module.name));
    }
  }

  void compare_rest(const Config& next) {
    if (without_modules(running_) != without_modules(next)) {
      restart("it differs outside of its modules");
    }
  }

  // All ticks stay where they are.
  void compare_grid(const config::CheckResult& check) {
    const base::Nanos now(run_.basic_period_ns);
    const base::Nanos then = check.periodic.empty() ? now : check.table.basic_period;
    if (then % now != base::Nanos::zero()) {
      restart(fmt::format("its basic period is {}, and the node ticks every {}", base::format_duration(then),
                          base::format_duration(now)));
    }
  }

  const Config& running_;
  const scheduler::RunBlock& run_;
  bool simulated_;
  SchedulePlan plan_;
  std::uint32_t new_ = 0;  // modules that the node never had
};

}  // namespace

const char* to_text(ModuleFate::Kind kind) noexcept {
  switch (kind) {
    case ModuleFate::Kind::Kept:
      return "kept";
    case ModuleFate::Kind::Rescheduled:
      return "rescheduled";
    case ModuleFate::Kind::Added:
      return "added";
    case ModuleFate::Kind::Ended:
      return "ended";
  }
  return "";
}

SchedulePlan plan_schedule(const Config& running, const scheduler::RunBlock& run, const Config& next,
                           const config::CheckResult& check) {
  return ScheduleComparison(running, run).run(next, check);
}

bool runs_file(const scheduler::ModuleRecord& module, const std::filesystem::path& file) {
  const auto digest = keys::digest_of_file(file);
  return digest && digest->digest == scheduler::running_digest(module);
}

void require_same_files(SchedulePlan& plan, const scheduler::RunBlock& run, const config::Config& next) {
  for (std::size_t i = 0; i < plan.indices.size(); ++i) {
    const std::uint32_t index = plan.indices[i];
    const Module& module = next.modules[i];
    if (index == SchedulePlan::kNoModule || run.modules()[index].ended) {
      continue;
    }
    if (!runs_file(run.modules()[index], module.file)) {
      plan.restarts.push_back(fmt::format("module {} runs another version than {}; `indurop reload {}` exchanges it",
                                          module.name, module.file.string(), module.name));
    }
  }
}

}  // namespace indurop::node
