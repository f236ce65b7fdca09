// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/task_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "control/plc/check/located_variables.h"
#include "control/plc/check/reach.h"
#include "control/plc/model/identifier.h"
#include "control/plc/st/literal.h"

namespace indurop::plc {
namespace {

class TaskPlanner {
 public:
  explicit TaskPlanner(Context& context) : context_(context) {}

  void configuration(const Configuration& configuration) {
    for (const Resource& resource : configuration.resources) {
      resource_ = &resource;
      tasks_ += resource.tasks.size();
      instances_ += resource.programs.size();
      if (tasks_ > kMostTasks || instances_ > kMostInstances) {
        context_.error(resource.at,
                       fmt::format("more than {} tasks or {} instances of programs", kMostTasks, kMostInstances));
        return;
      }
      for (const Task& task : resource.tasks) {
        declare(task, name_of(
                          configuration, task.name, [](const Resource& one) -> auto& { return one.tasks; }));
      }
      for (const ProgramInstance& one : resource.programs) {
        instance(one, name_of(
                          configuration, one.name, [](const Resource& each) -> auto& { return each.programs; }));
      }
    }
  }

  // Adds programs that no configuration mentions.
  void rest(bool configured) {
    TaskPlan* plan = nullptr;
    for (const Pou& pou : context_.program.pous) {
      if (pou.tree->kind != ast::Pou::Kind::Program || mentioned_.contains(&pou)) {
        continue;
      }
      if (pou.instance != nullptr && is_called(pou)) {
        continue;  // it runs in another one
      }
      if (configured) {
        context_.warning(pou.tree->at, fmt::format("the program {} is in no task and never runs", pou.name));
        continue;
      }
      plan = plan != nullptr ? plan : &default_task();
      plan->programs.push_back({pou.name, &pou});
    }
  }

 private:
  [[nodiscard]] bool is_called(const Pou& pou) const {
    const auto& all = context_.program.pous;
    return std::any_of(all.begin(), all.end(), [&](const Pou& one) { return one.calls.contains(&pou); });
  }

  TaskPlan& default_task() {
    const auto known =
        std::find_if(tasks().begin(), tasks().end(), [](const TaskPlan& one) { return one.name.empty(); });
    if (known != tasks().end()) {
      return *known;
    }
    TaskPlan& made = tasks().emplace_back();
    made.interval_ns = kDefaultIntervalNs;
    return made;
  }

  // Returns the name, with that of the resource before it if another resource has the same one.
  template <class List>
  [[nodiscard]] std::string name_of(const Configuration& configuration, const std::string& name, List list) const {
    const auto has = [&](const Resource& resource) {
      const auto& all = list(resource);
      return &resource != resource_ &&
             std::any_of(all.begin(), all.end(), [&](const auto& one) { return same_name(one.name, name); });
    };
    const bool shared = std::any_of(configuration.resources.begin(), configuration.resources.end(), has);
    if (!shared || resource_->name.empty()) {
      return name;
    }
    if (std::string why = why_no_name(resource_->name);
        !why.empty()) {  // "Plc Logic" is valid where no name is derived from it
      context_.error(resource_->at, fmt::format("'{}' is in two resources, which tell them apart: {}", name, why));
      return name;
    }
    return resource_->name + "_" + name;
  }

  void declare(const Task& task, const std::string& name) {
    if (std::any_of(tasks().begin(), tasks().end(), [&](const auto& one) { return same_name(one.name, name); })) {
      context_.error(task.at, fmt::format("the task '{}' is declared twice, rename one of them", task.name));
      return;
    }
    const Global* single = task.single.empty() ? nullptr : single_of(task);
    if (!task.interval_ns && task.single.empty()) {
      context_.warning(
          task.at,
          fmt::format("the task {} has no interval and runs every 10 ms, write INTERVAL := T#10ms", task.name));
    }
    TaskPlan& made = tasks().emplace_back();
    made.at = task.at;
    made.name = name;
    in_resource_[{resource_, upper(task.name)}] = name;
    made.interval_ns = task.interval_ns.value_or(kDefaultIntervalNs);
    made.priority = task.priority.value_or(static_cast<std::int32_t>(tasks().size()));
    made.single = single;
    made.periodic = single == nullptr || task.interval_ns.has_value();
  }

  // Returns null after an error.
  const Global* single_of(const Task& task) {
    const auto known = context_.program.global_names.find(upper(task.single));
    const auto address = st::address_literal(task.single);
    const Global* found = known != context_.program.global_names.end() ? known->second
                          : address                                    ? &located_global(context_, *address, task.at)
                                                                       : nullptr;
    const bool fits = found != nullptr && found->type->is(Elementary::Bool) &&
                      (found->kind == Global::Kind::Own || found->kind == Global::Kind::Foreign);
    if (!fits) {
      context_.error(task.at,
                     fmt::format("SINGLE := {}: there is no global variable of this name that is a BOOL", task.single));
    }
    return fits ? found : nullptr;
  }

  void instance(const ProgramInstance& one, const std::string& name) {
    const auto pou = context_.program.pou_names.find(upper(one.type));
    if (pou == context_.program.pou_names.end() || pou->second->tree->kind != ast::Pou::Kind::Program) {
      context_.error(one.at, fmt::format("there is no PROGRAM '{}'", one.type));
      return;
    }
    if (!names_.insert(upper(name)).second) {
      context_.error(one.at, fmt::format("the instance '{}' is declared twice, rename one of them", one.name));
      return;
    }
    mentioned_.insert(pou->second);
    const auto known = in_resource_.find({resource_, upper(one.task)});
    const auto task = std::find_if(tasks().begin(), tasks().end(), [&](const TaskPlan& plan) {
      return known != in_resource_.end() && same_name(plan.name, known->second);
    });
    if (!one.task.empty() && task == tasks().end()) {
      context_.error(one.at, fmt::format("there is no TASK '{}'", one.task));
      return;
    }
    TaskPlan& plan = one.task.empty() ? default_task() : *task;
    plan.programs.push_back({name, pou->second, &one});
  }

  std::vector<TaskPlan>& tasks() { return context_.program.tasks; }

  static constexpr std::size_t kMostTasks = 1000;
  static constexpr std::size_t kMostInstances = 2000;

  Context& context_;
  std::size_t tasks_ = 0;
  std::size_t instances_ = 0;
  std::set<const Pou*> mentioned_;
  std::set<std::string> names_;
  const Resource* resource_ = nullptr;
  std::map<std::pair<const Resource*, std::string>, std::string> in_resource_;  // tasks as they are called outside
};

// Checks that a variable that cannot be shared is used in one module only.
void check_private_globals(Context& context) {
  std::map<const Global*, std::vector<std::string>> users_of;
  for (const TaskPlan& task : context.program.tasks) {
    std::set<const Global*> used;
    for (const TaskProgram& one : task.programs) {
      used.insert(one.pou->instance);
    }
    for (const Pou* pou : reached_by(task)) {
      for (const auto& [global, use] : pou->globals) {
        used.insert(global);
      }
    }
    for (const Global* one : used) {
      users_of[one].push_back(task.name);
    }
  }
  for (const Global& global : context.program.globals) {
    if (global.kind != Global::Kind::Private) {
      continue;
    }
    const std::vector<std::string>& users = users_of[&global];
    const Pou* pou = global.type->pou;
    if (users.size() > 1 && pou != nullptr && pou->instance == &global) {
      context.error(global.at,
                    fmt::format("the tasks {} and {} both use the program {} by its name, and they are modules "
                                "of their own; declare what they share as VAR_GLOBAL",
                                users[0], users[1], pou->name));
    } else if (users.size() > 1) {
      context.error(global.at,
                    fmt::format("'{}' is an instance of a function block and used by the tasks {} and {}, which are "
                                "modules of their own; declare one instance for each",
                                global.name, users[0], users[1]));
    }
  }
}

// Checks that a program that other POUs use by its name has one instance only.
void check_named_programs(Context& context) {
  std::map<const Pou*, std::size_t> instances;
  for (const TaskPlan& task : context.program.tasks) {
    for (const TaskProgram& one : task.programs) {
      ++instances[one.pou];
    }
  }
  for (const Pou& pou : context.program.pous) {
    if (pou.instance != nullptr && instances[&pou] > 1) {
      context.error(pou.tree->at, fmt::format("{} has several instances, so its name does not say which one others "
                                              "mean; declare what they use as VAR_GLOBAL",
                                              pou.name));
    }
  }
}

}  // namespace

void plan_tasks(Context& context) {
  TaskPlanner planner(context);
  const auto& configurations = context.program.project.configurations;
  for (const Configuration& one : configurations) {
    planner.configuration(one);
  }
  const bool configured = std::any_of(configurations.begin(), configurations.end(), [](const Configuration& one) {
    return std::any_of(one.resources.begin(), one.resources.end(),
                       [](const Resource& resource) { return !resource.programs.empty(); });
  });
  planner.rest(configured);
  std::erase_if(context.program.tasks, [](const TaskPlan& one) { return one.programs.empty(); });
  check_private_globals(context);
  check_named_programs(context);
  if (context.program.tasks.empty() && !context.program.library && !context.diagnostics.failed()) {
    context.error({}, "there is no PROGRAM that could run, write one: PROGRAM main ... END_PROGRAM");
  }
}

}  // namespace indurop::plc
