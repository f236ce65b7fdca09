// SPDX-License-Identifier: Apache-2.0
// Single modules while the schedule runs: disable, check that they are at rest, enable.

#include <algorithm>

#include "scheduler/engine.h"

namespace indurop::scheduler {

TaskState* Engine::thread_module(std::uint32_t module) const noexcept {
  for (const auto& state : states_) {
    if (state->task.index == module && state->task.type == ModuleType::Thread) {
      return state.get();
    }
  }
  return nullptr;
}

bool Engine::disable(std::uint32_t module) noexcept {
  TaskState* state = thread_module(module);
  const Band* band = state == nullptr ? nullptr : schedule_->find_band(module);
  if (band == nullptr) {
    return false;
  }
  state->gate.store(Gate::Closed, std::memory_order_seq_cst);
  state->last_release = band->released();
  return true;
}

bool Engine::watch(std::uint32_t module, Exchange& exchange) noexcept {
  TaskState* state = thread_module(module);
  const Band* band = state == nullptr ? nullptr : schedule_->find_band(module);
  if (band == nullptr || state->is_closed()) {
    return false;
  }
  state->exchange = &exchange;
  Gate open = Gate::Open;
  const bool watched = state->gate.compare_exchange_strong(open, Gate::Watched, std::memory_order_seq_cst);
  state->last_release = band->released();
  return watched;
}

bool Engine::unwatch(std::uint32_t module) noexcept {
  TaskState* state = thread_module(module);
  const Band* band = state == nullptr ? nullptr : schedule_->find_band(module);
  if (band == nullptr) {
    return false;
  }
  Gate watched = Gate::Watched;
  const bool open = state->gate.compare_exchange_strong(watched, Gate::Open, std::memory_order_seq_cst);
  state->last_release = band->released();
  return open;
}

bool Engine::has_passed(std::uint32_t module) const noexcept {
  const TaskState* state = thread_module(module);
  const Band* band = state == nullptr ? nullptr : schedule_->find_band(module);
  return band == nullptr || (band->has_done(state->last_release) && !is_leaving(*state));
}

void Engine::replace_closed(std::uint32_t module, const Exchange::Code& code) noexcept {
  if (TaskState* state = thread_module(module); state != nullptr && state->is_closed()) {
    state->task.run = code.run;
    state->task.condition = code.condition;
  }
}

bool Engine::at_rest(std::uint32_t module) noexcept {
  TaskState* state = thread_module(module);
  Band* band = state == nullptr ? nullptr : schedule_->find_band(module);
  if (band == nullptr || has_passed(module)) {
    return true;
  }
  for (const Schedule* schedule : {schedule_.get(), retirement_.schedule()}) {
    Band* one = schedule == nullptr ? nullptr : schedule->find_band(module);
    if (one != nullptr && one->runner().current() == state) {
      one->runner().enforce_budget(kernel_.now(), true, settings_.stop_grace_ns);
    }
  }
  return false;
}

// The thread sets the module as its current one before it counts the entry, so the count is read first.
std::optional<std::uint64_t> Engine::entries_if_outside(std::uint32_t module) const noexcept {
  const TaskState* state = thread_module(module);
  Band* band = state == nullptr ? nullptr : schedule_->find_band(module);
  if (band == nullptr || next_ != nullptr || retirement_.schedule() != nullptr) {
    return std::nullopt;
  }
  const std::uint64_t entries = band->runner().entries();
  std::atomic_thread_fence(std::memory_order_acquire);
  return band->runner().current() == state ? std::nullopt : std::optional(entries);
}

void Engine::end_runs_in_progress() noexcept {
  const rt::MonoTime late = kernel_.now() + std::chrono::nanoseconds(settings_.stop_grace_ns);
  for (const auto& watched : watched_) {
    if (const Schedule* schedule = watched.load(std::memory_order_acquire); schedule != nullptr) {
      schedule->enforce_budgets(late, true, 0, 0);
    }
  }
}

void Engine::enable(std::uint32_t module) noexcept {
  if (TaskState* state = thread_module(module); state != nullptr) {
    state->gate.store(Gate::Open, std::memory_order_release);
  }
}

}  // namespace indurop::scheduler
