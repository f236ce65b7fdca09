// SPDX-License-Identifier: Apache-2.0
#include "scheduler/schedule.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scheduler/execution_order.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kWatchdogFastest = 1'000'000;
constexpr std::int64_t kWatchdogSlowest = 10'000'000;

std::int64_t watchdog_period_of(std::span<const Member> members) noexcept {
  std::int64_t period = kWatchdogSlowest;
  for (const Member& member : members) {
    if (member.task.budget_ns > 0) {
      period = std::min(period, std::max(member.task.budget_ns / 2, kWatchdogFastest));
    }
  }
  return period;
}

}  // namespace

// A band with what its order is decided by.
struct Schedule::Planned {
  Band* band = nullptr;
  std::vector<const Task*> tasks;  // without processes that an event handler signals

  [[nodiscard]] const BandPlan& plan() const noexcept { return band->plan(); }
};

namespace {

bool data_flows(std::span<const Task* const> from, std::span<const Task* const> to) noexcept {
  const auto waits = [](const Task* earlier, const Task* later) {
    return std::find(later->after.begin(), later->after.end(), earlier->index) != later->after.end();
  };
  return std::any_of(to.begin(), to.end(), [&](const Task* later) {
    return std::any_of(from.begin(), from.end(), [&](const Task* earlier) { return waits(earlier, later); });
  });
}

// Returns true if `band` must wait for `other`. Event handling waits for all periodic bands; bands handled directly
// after the base modules neither wait for others nor are waited for.
template <class Planned>
bool comes_before(const Planned& other, const Planned& band, CoreOrder order) noexcept {
  if (other.plan().kind == BandKind::AfterBase || band.plan().kind == BandKind::AfterBase) {
    return false;
  }
  if (band.plan().kind == BandKind::Handler || other.tasks.empty() || other.plan().core == band.plan().core) {
    return true;
  }
  return order == CoreOrder::Data ? data_flows(other.tasks, band.tasks)
                                  : other.tasks.front()->priority < band.tasks.front()->priority;
}

}  // namespace

Schedule::Schedule(const Parts& parts, std::vector<Member> members)
    : parts_(parts), members_(std::move(members)), watchdog_period_(watchdog_period_of(members_)) {
  std::vector<Planned> planned;
  (void)core(parts_.settings.primary_core);
  build_periodic(planned);
  build_sporadic(planned);
  // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): after the cores are known
  gated_ = !parts_.settings.realtime || cores_.size() > 1;
  connect_predecessors(planned);
}

Schedule::~Schedule() {
  request_stop();
  join();
}

Schedule::CoreBands& Schedule::core(int number) {
  for (const auto& known : cores_) {
    if (known->core == number) {
      return *known;
    }
  }
  cores_.push_back(std::make_unique<CoreBands>());
  cores_.back()->schedule = this;
  cores_.back()->core = number;
  return *cores_.back();
}

const Schedule::CoreBands& Schedule::on(int number) noexcept {
  return core(number);
}

void Schedule::add_band(std::vector<Planned>& planned, const BandPlan& plan, const std::vector<std::size_t>& threads,
                        const std::vector<std::size_t>& processes) {
  CoreBands& home = core(plan.core);
  Planned one;
  std::vector<TaskState*> tasks;
  for (const std::size_t i : threads) {
    one.tasks.push_back(&members_[i].task);
    tasks.push_back(members_[i].state);
    home.members.push_back(members_[i]);
  }
  std::vector<TaskState*> signalled;
  for (const std::size_t i : processes) {
    signalled.push_back(members_[i].state);
    home.members.push_back(members_[i]);
  }
  bands_.push_back(std::make_unique<Band>(plan, std::move(tasks), std::move(signalled), parts_.block, parts_.kernel,
                                          parts_.hooks, parts_.trace(plan.core), parts_.settings.basic_period_ns));
  one.band = bands_.back().get();
  (in_tick_thread(plan.kind) ? home.here : home.released).push_back(one.band);
  planned.push_back(std::move(one));
}

void Schedule::build_periodic(std::vector<Planned>& planned) {
  std::vector<Task> plain;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].task.operation == Operation::Periodic) {
      plain.push_back(members_[i].task);
      places.push_back(i);
    }
  }
  for (const BandPlan& plan : make_bands(plain, parts_.settings.basic_period_ns, parts_.settings.order)) {
    std::vector<std::size_t> members;
    for (const std::uint32_t i : plan.tasks) {
      members.push_back(places[i]);
    }
    add_band(planned, plan, members, {});
  }
}

void Schedule::build_sporadic(std::vector<Planned>& planned) {
  std::vector<std::size_t> early;
  std::vector<std::size_t> threads;
  std::vector<std::size_t> processes;
  for (const std::uint32_t i :
       execution_order(members_.size(), [&](std::uint32_t member) { return members_[member].task.priority; })) {
    const Task& task = members_[i].task;
    if (task.operation == Operation::Sporadic) {
      (task.type == ModuleType::Process ? processes : task.after_base ? early : threads).push_back(i);
    }
  }
  BandPlan plan;
  plan.core = parts_.settings.primary_core;
  plan.period_ns = parts_.settings.basic_period_ns;
  if (!early.empty()) {
    plan.kind = BandKind::AfterBase;
    plan.fifo_priority = kTickPriority;
    add_band(planned, plan, early, {});
  }
  if (!threads.empty() || !processes.empty()) {
    plan.kind = BandKind::Handler;
    plan.fifo_priority = kHandlerPriority;
    add_band(planned, plan, threads, processes);
  }
}

// Needed only where FIFO priorities of one core do not already give the order: several cores, no real-time privileges,
// or a band that waits for another core and so lets later ones pass.
void Schedule::connect_predecessors(const std::vector<Planned>& planned) {
  if (!gated_) {
    return;
  }
  for (std::size_t i = 0; i < planned.size(); ++i) {
    const Planned& one = planned[i];
    std::vector<Band*> before;
    for (std::size_t k = 0; k < i; ++k) {
      const Planned& other = planned[k];
      const bool overtakes = other.band->waits_for_others() &&
                             (one.plan().kind == BandKind::Handler || data_flows(other.tasks, one.tasks));
      const bool priorities_suffice = parts_.settings.realtime && other.plan().core == one.plan().core && !overtakes;
      if (comes_before(other, one, parts_.settings.order) && !priorities_suffice) {
        before.push_back(other.band);
      }
    }
    one.band->set_predecessors(std::move(before));
    one.band->set_done_callback([](void* self) noexcept { static_cast<Schedule*>(self)->wake_waiting(); }, this);
  }
}

void Schedule::wake_waiting() const noexcept {
  for (const auto& band : bands_) {
    band->check_again();
  }
}

bool Schedule::has_thread(const Band& band) noexcept {
  return !in_tick_thread(band.plan().kind) && (band.plan().kind != BandKind::Process || band.waits_for_others());
}

Status Schedule::start_threads() {
  for (const auto& band : bands_) {
    const BandPlan& plan = band->plan();
    if (!has_thread(*band)) {
      continue;
    }
    rt::ThreadSettings settings;
    settings.name = plan.kind == BandKind::Handler ? "irp-events" : "irp-band-" + std::to_string(plan.fifo_priority);
    settings.fifo_priority = parts_.settings.realtime ? plan.fifo_priority : 0;
    settings.core = parts_.settings.realtime ? plan.core : -1;
    settings.runs_modules = true;
    auto thread = parts_.kernel.start(settings, [&band = *band] { band.loop(); });
    if (!thread) {
      return thread.error();
    }
    threads_.push_back(std::move(thread).value());
  }
  return {};
}

void Schedule::drain() const noexcept {
  for (const auto& band : bands_) {
    if (!in_tick_thread(band->plan().kind)) {
      band->drain();
    }
  }
}

void Schedule::enforce_budgets(rt::MonoTime now, bool stopping, std::int64_t grace_ns,
                               std::int64_t late_ns) const noexcept {
  for (const auto& band : bands_) {
    band->runner().enforce_budget(now, stopping, grace_ns, late_ns);
  }
}

void Schedule::finish() const noexcept {
  for (const auto& band : bands_) {
    band->finish();
  }
}

void Schedule::request_stop() noexcept {
  for (const auto& band : bands_) {
    band->stop();
  }
}

void Schedule::join() noexcept {
  for (const auto& thread : threads_) {
    thread->join();
  }
  threads_.clear();
}

void Schedule::publish_priorities() const noexcept {
  for (const Member& member : members_) {
    member.state->record->fifo_priority = priority_of(member.task.index);
  }
}

int Schedule::priority_of(std::uint32_t module) const noexcept {
  const auto has = [module](std::span<TaskState* const> states) {
    return std::any_of(states.begin(), states.end(),
                       [module](const TaskState* state) { return state->task.index == module; });
  };
  for (const auto& band : bands_) {
    if (has(band->tasks()) || has(band->processes())) {
      return !parts_.settings.realtime ? 0 : has(band->tasks()) ? band->plan().fifo_priority : kSporadicProcessPriority;
    }
  }
  return 0;
}

Band* Schedule::find_band(std::uint32_t module) const noexcept {
  const auto found = std::find_if(bands_.begin(), bands_.end(), [module](const auto& band) {
    return std::any_of(band->tasks().begin(), band->tasks().end(), [module](const TaskState* state) {
      return state->task.index == module && state->task.legacy_signal == 0;
    });
  });
  return found == bands_.end() ? nullptr : found->get();
}

bool Schedule::is_ready() const noexcept {
  return std::all_of(bands_.begin(), bands_.end(),
                     [](const auto& band) { return !has_thread(*band) || band->runner().is_attached(); });
}

bool Schedule::is_at_rest() const noexcept {
  return std::all_of(bands_.begin(), bands_.end(), [](const auto& band) { return band->has_done(band->released()); });
}

}  // namespace indurop::scheduler
