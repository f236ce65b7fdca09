// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/arrivals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/rt/clock.h"
#include "scheduler/module_version.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;

constexpr std::chrono::seconds kArrivalStartLimit{10};
constexpr std::chrono::milliseconds kArrivalPoll{1};
constexpr const char* kOtherVariables = "another version has brought other variables meanwhile; repeat the command";

}  // namespace

void Arrivals::begin(const Rechecked& next, const SchedulePlan& plan) {
  next_ = &next;
  all_.clear();
  errors_.clear();
  failure_.clear();
  needs_restart_ = true;
  refused_.clear();
  loaded_ = 0;
  started_ = 0;
  for (const std::uint32_t place : plan.added) {
    One& one = all_.emplace_back();
    one.place = place;
    one.index = plan.indices[place];
    one.is_process = configured(one).type == scheduler::ModuleType::Process;
    one.is_in_background = configured(one).operation == scheduler::Operation::NonReal;
    one.loads = one.index == SchedulePlan::kNoModule || one.is_process || !runs_file(record(one), configured(one).file);
  }
  load_next();
}

void Arrivals::load_next() {
  while (loaded_ < all_.size() && !all_[loaded_].loads) {
    ++loaded_;
  }
  if (loaded_ < all_.size()) {
    const One& one = all_[loaded_];
    loading_ = std::make_unique<CandidateThread>(
        CandidateTask{next_->config, one.place, next_->config.modules[one.place].file, parts_.store,
                      next_->check.facts[one.place].file.access, none_, one.index, next_->mirror.has_value()});
  }
}

bool Arrivals::is_loaded() {
  if (loading_ == nullptr) {
    return true;
  }
  if (loading_->is_done()) {
    Candidate candidate = loading_->take();
    loading_.reset();
    errors_.insert(errors_.end(), candidate.errors.begin(), candidate.errors.end());
    if (!candidate.errors.empty()) {
      needs_restart_ = needs_restart_ && candidate.needs_restart;
      refused_ = next_->config.modules[all_[loaded_].place].name;
    }
    all_[loaded_].digest = candidate.digest;
    all_[loaded_].variables = std::move(candidate.variables);
    all_[loaded_++].library = std::move(candidate.library);
    load_next();
  }
  return loading_ == nullptr;
}

void Arrivals::list_variables(operate::ScheduleReport& report) const {
  for (const One& one : all_) {
    operate::ReloadPlan plan;
    (void)one.variables.list(parts_.store, plan);
    const std::string& name = next_->config.modules[one.place].name;
    const auto found = std::find_if(report.modules.begin(), report.modules.end(),
                                    [&name](const auto& module) { return module.name == name; });
    if (found != report.modules.end() && !plan.appeared.empty()) {
      found->text = fmt::format("new: {}", fmt::join(plan.appeared, ", "));
    }
  }
}

bool Arrivals::place(SchedulePlan& plan, const scheduler::RunBlockSetup& setup,
                     const std::vector<scheduler::Task>& tasks) {
  for (One& one : all_) {
    if (one.index == SchedulePlan::kNoModule) {
      const std::uint32_t index = add(one, setup.modules[one.place]);
      if (index == SchedulePlan::kNoModule) {
        return false;
      }
      plan.indices[one.place] = one.index = index;
    } else if (one.is_process) {
      parts_.processes.set_file(one.index, configured(one).file, one.digest);
      parts_.libraries[one.index].set_uses(one.library.uses());
    } else if (one.loads) {
      replace_code(one);
    }
    if (one.loads) {
      offer(one, tasks);
    }
  }
  return true;
}

// What runs in the background has no task.
void Arrivals::offer(const One& one, const std::vector<scheduler::Task>& tasks) {
  const auto task =
      std::find_if(tasks.begin(), tasks.end(), [&one](const scheduler::Task& each) { return each.index == one.place; });
  if (task == tasks.end()) {
    return;
  }
  scheduler::Task offered = *task;
  offered.index = one.index;
  offered.after.clear();
  if (!one.is_process) {
    offered.run = parts_.libraries[one.index].functions().run;
    if (offered.operation == scheduler::Operation::Sporadic) {
      offered.condition = parts_.libraries[one.index].functions().condition;
    }
  }
  parts_.engine.offer(offered);
}

// All that is counted by modules grows by one.
std::uint32_t Arrivals::add(One& one, const scheduler::ModuleSetup& setup) {
  const auto index = scheduler::add_module(parts_.run, setup);
  if (!index) {
    return SchedulePlan::kNoModule;
  }
  parts_.config.modules.push_back(next_->config.modules[one.place]);
  parts_.libraries.push_back(std::move(one.library));
  parts_.failsafe.add(parts_.config.modules.back());
  parts_.processes.add(*index, parts_.config.modules.back());
  parts_.exchanges.add(next_->check.facts[one.place].file.access,
                       configured_uses_of(next_->check, one.place, next_->config.modules[one.place].name));
  return *index;
}

// Of one that has ended.
void Arrivals::replace_code(One& one) {
  ModuleLibrary& library = parts_.libraries[one.index];
  if (parts_.run.modules()[one.index].faults.load() > 0) {
    library.abandon();
  } else {
    (void)library.unload();
  }
  library = std::move(one.library);
  scheduler::set_version(record(one), library.digest(), parts_.run.tick.load(), scheduler::VersionState::Settled);
}

bool Arrivals::is_started(rt::MonoTime now) {
  while (started_ < all_.size()) {
    if (!start(all_[started_], now)) {
      return false;
    }
    ++started_;
  }
  for (One& one : all_) {
    if (!one.variables.let_appear(parts_.store)) {
      return fail(one, kOtherVariables);
    }
  }
  return true;
}

// Returns true when it has started.
bool Arrivals::start(One& one, rt::MonoTime now) {
  if (one.is_process) {
    return one.is_in_background || start_process(one, now);
  }
  if (call_ == nullptr) {
    auto* const start = parts_.libraries[one.index].functions().start;
    if (start == nullptr) {
      one.begun = true;
      return true;
    }
    call_ = parts_.phases.begin(one.index, "start", start);
    return call_ == nullptr && fail(one, "start() could not be called");
  }
  if (!parts_.phases.ended(*call_, now, kArrivalStartLimit)) {
    return false;
  }
  one.begun = parts_.phases.conclude(std::move(call_));
  if (!one.begun) {
    record(one).state.store(ModuleState::Stopped);  // it is in no schedule
  }
  return one.begun || fail(one, record(one).last_fault);
}

// Its variables appear first: it binds them when it begins.
bool Arrivals::start_process(One& one, rt::MonoTime now) {
  if (!one.begun) {
    if (!one.variables.let_appear(parts_.store)) {
      return fail(one, kOtherVariables);
    }
    one.begun = true;
    one.launched = now;
    return !parts_.processes.start_aside(one.index) && fail(one, "its process cannot be launched");
  }
  const ModuleState state = record(one).state.load();
  if (state == ModuleState::Faulted) {
    return fail(one, record(one).last_fault);
  }
  if (state != ModuleState::Running && now - one.launched > kArrivalStartLimit) {
    return fail(one, configured(one).signal != 0 ? "it does not expect its signal within 10 s"
                                                 : "it has not called irp::waitPeriod() within 10 s");
  }
  return state == ModuleState::Running;
}

bool Arrivals::fail(const One& one, const std::string& why) {
  failure_ = fmt::format("module {}: {}", configured(one).name, why);
  refused_ = configured(one).name;
  return false;
}

// Nothing of them is entered before the first tick of their schedule.
bool Arrivals::enter() {
  for (const One& one : all_) {
    if (one.is_process && !one.is_in_background && record(one).state.load() != ModuleState::Running) {
      return fail(one, record(one).last_fault);
    }
  }
  for (const One& one : all_) {
    if (one.is_in_background) {
      continue;
    }
    if (one.is_process) {
      parts_.processes.let_run(one.index);
      continue;
    }
    if (tape::Track* track = parts_.tape == nullptr ? nullptr : parts_.tape->of(one.index)) {
      track->note_restart();
    }
    record(one).state.store(ModuleState::Running);
    parts_.engine.enable(one.index);
  }
  return true;
}

void Arrivals::settle() {
  for (const One& one : all_) {
    if (one.is_in_background) {
      begin_in_background(one);
    }
  }
  all_.clear();
  started_ = 0;
}

void Arrivals::begin_in_background(const One& one) {
  if (one.is_process ? !parts_.processes.start(one.index) : !parts_.normal_threads.launch(one.index)) {
    record(one).state.store(ModuleState::Faulted);
    parts_.console.error("module {}: it could not be started in the background", record(one).name);
  }
}

std::vector<std::uint32_t> Arrivals::drop() {
  std::vector<std::uint32_t> begun;
  for (const One& one : all_) {
    if (one.begun) {
      begun.push_back(one.index);
      if (!one.is_process) {
        record(one).state.store(ModuleState::Running);  // it has a stop() to be called
      }
    } else if (one.index != SchedulePlan::kNoModule) {
      record(one).state.store(ModuleState::Stopped);
    }
  }
  all_.clear();
  started_ = 0;
  return begun;
}

void Arrivals::end() {
  if (loading_ != nullptr) {
    (void)loading_->take();
    loading_.reset();
  }
  while (call_ != nullptr && !parts_.phases.ended(*call_, rt::MonoClock::now(), Phases::kGrace)) {
    rt::sleep_until(rt::MonoClock::now() + kArrivalPoll);
  }
  if (call_ != nullptr) {
    all_[started_].begun = parts_.phases.conclude(std::move(call_));
  }
  for (const One& one : all_) {
    if (one.begun && !one.is_process) {
      record(one).state.store(ModuleState::Loaded);  // its stop() is called with the others
    }
  }
}

}  // namespace indurop::node
