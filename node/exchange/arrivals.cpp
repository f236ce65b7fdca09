// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/arrivals.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/keys/digest.h"
#include "core/rt/clock.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;

constexpr std::chrono::seconds kArrivalStartLimit{10};
constexpr std::chrono::milliseconds kArrivalPoll{1};

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
    const auto digest = keys::digest_of_file(next.config.modules[place].file);
    one.loads =
        one.index == SchedulePlan::kNoModule || !digest || digest->digest != parts_.libraries[one.index].digest();
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
    } else if (one.loads) {
      replace_code(one);
    }
    const auto task = std::find_if(tasks.begin(), tasks.end(),
                                   [&one](const scheduler::Task& each) { return each.index == one.place; });
    if (one.loads && task != tasks.end()) {
      scheduler::Task offered = *task;
      offered.index = one.index;
      offered.after.clear();
      offered.run = parts_.libraries[one.index].functions().run;
      if (offered.operation == scheduler::Operation::Sporadic) {
        offered.condition = parts_.libraries[one.index].functions().condition;
      }
      parts_.engine.offer(offered);
    }
  }
  return true;
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
}

bool Arrivals::is_started(rt::MonoTime now) {
  if (call_ != nullptr) {
    if (!parts_.phases.ended(*call_, now, kArrivalStartLimit)) {
      return false;
    }
    scheduler::ModuleRecord& record = parts_.run.modules()[all_[started_].index];
    if (!parts_.phases.conclude(std::move(call_))) {
      record.state.store(ModuleState::Stopped);  // it is in no schedule
      failure_ = fmt::format("module {}: {}", record.name, record.last_fault);
      refused_ = record.name;
      return false;
    }
    ++started_;
  }
  for (; started_ < all_.size(); ++started_) {
    const std::uint32_t index = all_[started_].index;
    if (auto* start = parts_.libraries[index].functions().start; start != nullptr) {
      call_ = parts_.phases.begin(index, "start", start);
      failure_ = call_ == nullptr ? "start() could not be called" : "";
      return false;
    }
  }
  for (One& one : all_) {
    if (!one.variables.let_appear(parts_.store)) {
      failure_ = "another version has brought other variables meanwhile; repeat the command";
      return false;
    }
  }
  return true;
}

// Nothing of them is entered before the first tick of their schedule.
void Arrivals::enter() {
  for (const One& one : all_) {
    if (tape::Track* track = parts_.tape == nullptr ? nullptr : parts_.tape->of(one.index)) {
      track->note_restart();
    }
    parts_.run.modules()[one.index].state.store(ModuleState::Running);
    parts_.engine.enable(one.index);
  }
}

void Arrivals::settle() {
  all_.clear();
  started_ = 0;
}

std::vector<std::uint32_t> Arrivals::drop() {
  std::vector<std::uint32_t> started;
  for (std::size_t i = 0; i < started_; ++i) {
    parts_.run.modules()[all_[i].index].state.store(ModuleState::Running);  // it has a stop() to be called
    started.push_back(all_[i].index);
  }
  for (std::size_t i = started_; i < all_.size(); ++i) {
    if (all_[i].index != SchedulePlan::kNoModule) {
      parts_.run.modules()[all_[i].index].state.store(ModuleState::Stopped);
    }
  }
  settle();
  return started;
}

void Arrivals::end() {
  if (loading_ != nullptr) {
    (void)loading_->take();
    loading_.reset();
  }
  while (call_ != nullptr && !parts_.phases.ended(*call_, rt::MonoClock::now(), Phases::kGrace)) {
    rt::sleep_until(rt::MonoClock::now() + kArrivalPoll);
  }
  if (call_ != nullptr && parts_.phases.conclude(std::move(call_))) {
    ++started_;
  }
  for (std::size_t i = 0; i < started_; ++i) {
    parts_.run.modules()[all_[i].index].state.store(ModuleState::Loaded);  // its stop() is called with the others
  }
}

}  // namespace indurop::node
