// SPDX-License-Identifier: Apache-2.0
// How another schedule takes over. A normal thread builds it and proposes a tick; every tick thread replaces one
// pointer when it begins that tick. All of them do, or none: the proposal counts once it is certain that no core has
// begun the tick, and a core that begins it before that refuses it.

#include <algorithm>
#include <utility>

#include "scheduler/engine.h"
#include "scheduler/engine_core.h"

namespace indurop::scheduler {
namespace {

// Event handling has time that no periodic module needs.
bool is_quiet(const Schedule::CoreBands& bands) noexcept {
  return std::none_of(bands.released.begin(), bands.released.end(),
                      [](const Band* band) { return band->plan().kind != BandKind::Handler && band->is_busy(); });
}

}  // namespace

void Engine::offer(const Task& task) {
  const auto known = std::find_if(states_.begin(), states_.end(),
                                  [&task](const auto& state) { return state->task.index == task.index; });
  if (known == states_.end()) {
    add_state(task);
  } else {
    (*known)->task = task;
  }
}

bool Engine::has_core(int number) const noexcept {
  return std::any_of(cores_.begin(), cores_.end(), [number](const auto& core) { return core->number == number; });
}

Status Engine::prepare_change(std::span<const Task> tasks) {
  if (next_ != nullptr || retirement_.schedule() != nullptr) {
    return Error{Errc::Busy, 0, "another change of the schedule is in progress"};
  }
  std::vector<Member> members;
  for (const Task& task : tasks) {
    const auto known = std::find_if(states_.begin(), states_.end(),
                                    [&task](const auto& state) { return state->task.index == task.index; });
    if (known == states_.end() || (*known)->task.core != task.core || !has_core(task.core)) {
      return Error{Errc::InvalidArgument, 0, "a task of another module or on another core"};
    }
    members.push_back({task, known->get(), schedule_->find_band(task.index)});
  }
  auto prepared = std::make_unique<Schedule>(schedule_parts(), std::move(members));
  if (Status started = prepared->start_threads(); !started) {
    return started;
  }
  for (const Member& member : prepared->members()) {
    if (member.before == nullptr) {
      member.state->record->fifo_priority = prepared->priority_of(member.task.index);
    }
  }
  next_ = std::move(prepared);
  for (const auto& core : cores_) {
    core->next = &next_->on(core->number);
    core->follows.store(false, std::memory_order_relaxed);
  }
  watched_[1].store(next_.get(), std::memory_order_release);
  return {};
}

bool Engine::change_at(const ChangeProposal::Time& time) noexcept {
  proposal_.propose(time);
  const bool early = std::all_of(cores_.begin(), cores_.end(), [&time](const auto& core) {
    return core->begun.load(std::memory_order_seq_cst) <= time.tick;
  });
  if (early && proposal_.confirm()) {
    return true;
  }
  proposal_.take_back();
  return false;
}

// Tick thread. Returns how many of the lost ticks before this one are the new schedule's. What both schedules are
// feasible for does not include runs of one and releases of the other.
std::uint64_t Engine::follow(Core& core, std::uint64_t tick, std::uint64_t lost) noexcept {
  const auto first = proposal_.due(tick);
  if (!first || core.bands == core.next) {
    return lost;
  }
  if (cores_.size() == 1 && !is_quiet(*core.bands)) {
    proposal_.postpone(tick);
    return lost;
  }
  take_over(core, *first);
  return std::min(lost, tick - *first);
}

void Engine::take_over(Core& core, std::uint64_t tick) noexcept {
  for (const auto* bands : {&core.bands->here, &core.bands->released}) {
    for (Band* band : *bands) {
      band->leave_at(tick);
    }
  }
  if (core.bands->schedule->is_gated()) {
    core.bands->schedule->wake_waiting();
  }
  for (const Member& member : core.next->members) {
    member.state->task.overrun = member.task.overrun;
    member.state->task.budget_ns = member.task.budget_ns;
    member.state->task.work_ns = member.task.work_ns;
    member.state->leaving.store(member.before, std::memory_order_release);
  }
  for (Band* band : core.bands->here) {
    band->runner().detach_thread();
  }
  core.bands = core.next;
  for (const auto* bands : {&core.bands->here, &core.bands->released}) {
    for (Band* band : *bands) {
      band->begin_at(tick);
    }
  }
  for (Band* band : core.bands->here) {
    if (core.thread) {
      band->runner().attach(*core.thread);
    }
  }
  core.follows.store(true, std::memory_order_release);
}

// All cores run by the next schedule.
void Engine::note_change() noexcept {
  changed_at_ = proposal_.tick();
  proposal_.take_back();
  retirement_.begin(std::exchange(schedule_, std::move(next_)));
  watched_[0].store(schedule_.get(), std::memory_order_seq_cst);
  watched_[1].store(retirement_.schedule(), std::memory_order_seq_cst);
  schedule_->publish_priorities();
  for (const auto& state : states_) {
    if (const Band* band = schedule_->find_band(state->task.index); band != nullptr) {
      state->last_release = band->released();
    }
  }
}

void Engine::drop_change() noexcept {
  if (next_ != nullptr && !proposal_.is_there()) {
    retirement_.begin(std::move(next_));
  }
}

// Returns true when it is over.
bool Engine::follow_retirement() noexcept {
  if (!retirement_.is_closed() && retirement_.is_at_rest()) {
    watched_[1].store(nullptr, std::memory_order_seq_cst);
    for (const auto& state : states_) {
      state->leaving.store(nullptr, std::memory_order_seq_cst);
    }
    retirement_.close(*schedule_, watchdog_passes_.load(std::memory_order_acquire));
  }
  const bool over = retirement_.is_closed() &&
                    retirement_.is_over(*schedule_, watchdog_passes_.load(std::memory_order_acquire),
                                        watchdog_ != nullptr && !finished()) &&
                    readers_.load(std::memory_order_seq_cst) == 0;
  if (over) {
    retirement_.end();
  }
  return over;
}

// Both schedules count: between the tick of a change and the moment it is noted, the runs are those of the next one.
std::uint64_t Engine::activity_of(std::span<const std::uint32_t> modules) const noexcept {
  readers_.fetch_add(1, std::memory_order_seq_cst);
  const Schedule* const first = watched_[0].load(std::memory_order_seq_cst);
  const Schedule* const second = watched_[1].load(std::memory_order_seq_cst);
  bool busy = watched_[0].load(std::memory_order_seq_cst) != first;  // they were replaced at this moment
  std::uint64_t runs = 0;
  for (const Schedule* const schedule : {first, second}) {
    for (const std::uint32_t module : modules) {
      if (const Band* const band = schedule == nullptr ? nullptr : schedule->find_band(module); band != nullptr) {
        const std::uint64_t activity = band->activity();
        busy = busy || activity % 2 != 0;
        runs += activity / 2;
      }
    }
  }
  readers_.fetch_sub(1, std::memory_order_seq_cst);
  return 2 * runs + (busy ? 1 : 0);
}

Engine::Change Engine::follow_change() noexcept {
  if (next_ != nullptr) {
    if (!proposal_.is_there()) {
      return next_->is_ready() ? Change::Prepared : Change::Starting;
    }
    if (!std::all_of(cores_.begin(), cores_.end(),
                     [](const auto& core) { return core->follows.load(std::memory_order_acquire); })) {
      return Change::Waiting;
    }
    note_change();
  }
  return retirement_.schedule() == nullptr || follow_retirement() ? Change::None : Change::Leaving;
}

}  // namespace indurop::scheduler
