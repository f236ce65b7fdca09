// SPDX-License-Identifier: Apache-2.0
#include "scheduler/runner.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <exception>

#include "core/rt/copy_text.h"
#include "core/rt/guard_text.h"
#include "core/rt/lost_pages.h"

namespace indurop::scheduler {
namespace {

constexpr std::size_t kSoon = 3;  // modules ahead: memory answers in about the time of two of the shortest runs

// Thrown when a simulated run has used up its budget.
class TooLong : public std::exception {};

}  // namespace

void record_fault(ModuleRecord& record, FaultKind kind, std::uint64_t tick, std::string_view text) noexcept {
  rt::copy_text(record.last_fault, text);
  record.fault_tick.store(tick, std::memory_order_relaxed);
  record.fault_kind.store(static_cast<std::uint32_t>(kind), std::memory_order_release);
  record.faults.fetch_add(1, std::memory_order_release);  // a reader that sees the count sees the text
}

void quarantine(TaskState& state, FaultKind kind, std::uint64_t tick, const char* text, const Hooks& hooks) noexcept {
  ModuleRecord& record = *state.record;
  const bool continues = state.gate.load(std::memory_order_acquire) == Gate::Watched && state.exchange->fail();
  if (!continues) {
    state.gate.store(Gate::Closed, std::memory_order_release);
  }
  record_fault(record, kind, tick, text);
  if (!continues) {
    record.state.store(ModuleState::Faulted, std::memory_order_release);
  }
  if (hooks.faulted != nullptr) {
    hooks.faulted(hooks.context, state.task.index);
  }
  if (!continues && state.task.overrun == OverrunPolicy::StopNode && hooks.stop_node != nullptr) {
    hooks.stop_node(hooks.context, state.task.index, "a module with overrun policy stop-node faulted");
  }
}

Runner::Runner(RunBlock& block, Kernel& kernel, const Hooks& hooks, CoreTrace& trace, std::size_t max_tasks)
    : block_(block),
      kernel_(kernel),
      virtual_time_(kernel.is_virtual()),
      hooks_(hooks),
      trace_(trace),
      times_(max_tasks) {}

void Runner::attach(const ModuleThread& thread) noexcept {
  thread_ = thread;
  attached_.store(true, std::memory_order_release);
}

void Runner::detach_thread() noexcept {
  attached_.store(false, std::memory_order_release);
  guard_.leave();
}

void Runner::run(std::span<TaskState* const> tasks, std::uint64_t tick, rt::MonoTime release) noexcept {
  tasks_ = tasks;
  tick_ = tick;
  release_ns_ = rt::to_ns(release);
  position_ = 0;
  guard_.enter();
  // A fault jumps back to this point, after the module that caused it. No signal mask is saved: that would be a system
  // call.
  if (sigsetjmp(guard_.target(), 0) != 0) [[unlikely]] {
    contain_jump();
    ++position_;
  }
  current_start_.store(rt::to_ns(kernel_.now()), std::memory_order_relaxed);
  hooks_were_slow_ = false;
  for (; position_ < tasks_.size(); ++position_) {
    if (hooks_.soon != nullptr && position_ + kSoon < tasks_.size()) {
      hooks_.soon(hooks_.context, tasks_[position_ + kSoon]->task.index);
    }
    // Ordered with the band's release number, so that Engine::disable() knows which runs may still enter it.
    const Gate gate = tasks_[position_]->gate.load(std::memory_order_seq_cst);
    if (gate == Gate::Open) [[likely]] {
      call_current();
    } else if (gate == Gate::Watched) {
      call_watched();
    } else {
      times_[position_] = {};
    }
  }
  current_.store(nullptr, std::memory_order_release);
  account();
}

inline void Runner::call_current() noexcept {
  if (virtual_time_) {
    call<true>();
  } else {
    call<false>();
  }
}

// A fault of the run jumps over what follows it here.
[[gnu::noinline]] void Runner::call_watched() noexcept {
  TaskState& state = *tasks_[position_];
  if (state.exchange->before_run(state.task, tick_, kernel_) && hooks_.exchanged != nullptr) {
    hooks_.exchanged(hooks_.context, state.task.index);
  }
  call_current();
  state.exchange->after_run(times_[position_]);
}

// Two functions from one text: the simulation's part costs a real run nothing.
template <bool kVirtualTime>
void Runner::call() noexcept {
  TaskState& state = *tasks_[position_];
  previous_.store(trace_.module.load(std::memory_order_relaxed), std::memory_order_relaxed);
  previous_exec_.store(trace_.exec_ns.load(std::memory_order_relaxed), std::memory_order_relaxed);
  current_.store(&state, std::memory_order_release);
  if (hooks_.entering != nullptr) {
    hooks_.entering(hooks_.context, state.task.index, tick_, release_ns_);
  }
  if (!state.task.condition) {
    call_begin_hook();
  }
  char text[kTextLength];
  bool ran = true;
  bool threw = false;
  guard_.arm();
  try {
    if (state.task.condition) {
      ran = state.task.condition();
      current_start_.store(rt::to_ns(kernel_.now()), std::memory_order_relaxed);
      hooks_were_slow_ = false;
      if (ran) {
        call_begin_hook();
      }
    }
    if (ran) {
      state.task.run();
      if constexpr (kVirtualTime) {
        spend_time(state.task);
      }
    }
  } catch (const std::exception& error) {
    guard_.disarm();
    if constexpr (kVirtualTime) {
      if (dynamic_cast<const TooLong*>(&error) != nullptr) {
        std::snprintf(text, sizeof text, "did not return within %lld us",
                      static_cast<long long>(state.task.budget_ns / 1000));
        contain(FaultKind::Budget, text);
        return;
      }
    }
    threw = true;
    std::snprintf(text, sizeof text, "exception: %s", error.what());
  } catch (...) {
    guard_.disarm();
    threw = true;
    std::snprintf(text, sizeof text, "exception of an unknown type");
  }
  guard_.disarm();
  conclude(ran, threw ? text : nullptr);
}

// `threw`: description of the exception, null if it returned. `ran`: false if its condition was not met.
void Runner::conclude(bool ran, const char* threw) noexcept {
  TaskState& state = *tasks_[position_];
  const std::int64_t start = current_start_.load(std::memory_order_relaxed);
  const std::int64_t end = rt::to_ns(kernel_.now());
  times_[position_] = ran ? RunTimes{release_ns_, start, end} : RunTimes{};
  if (ran) {
    trace_.module.store(static_cast<std::int32_t>(state.task.index), std::memory_order_relaxed);
    trace_.exec_ns.store(end - start, std::memory_order_relaxed);
  }
  current_start_.store(end, std::memory_order_relaxed);  // the next module starts where this one ended
  if (threw != nullptr) [[unlikely]] {
    quarantine(state, FaultKind::Exception, tick_, threw, hooks_);
  }
  if (ran) {
    call_end_hook(threw != nullptr);
  }
}

// In a simulation: lets the time of the run pass, but at most its budget.
void Runner::spend_time(const Task& task) {
  if (task.budget_ns > 0 && task.work_ns > task.budget_ns) {
    kernel_.work(task.budget_ns);
    throw TooLong();
  }
  kernel_.work(task.work_ns);
}

void Runner::contain_jump() noexcept {
  guard_.recovered();
  const std::int64_t start = current_start_.load(std::memory_order_relaxed);
  const std::int64_t end = rt::to_ns(kernel_.now());
  char text[kTextLength];
  FaultKind kind = FaultKind::Signal;
  if (guard_.signal_number() == rt::Guard::kOrder) {
    kind = FaultKind::Budget;
    // In virtual time, no time has passed.
    end == start ? std::snprintf(text, sizeof text, "did not return")
                 : std::snprintf(text, sizeof text, "did not return within %lld us",
                                 static_cast<long long>((end - start) / 1000));
  } else if (guard_.signal_number() == SIGBUS && rt::is_guarded(guard_.fault_address())) {
    std::snprintf(text, sizeof text, "the node's shared memory was cut while it ran");
  } else {
    rt::describe_fault(guard_, thread_.stack, text, sizeof text);
  }
  contain(kind, text);
}

void Runner::contain(FaultKind kind, const char* text) noexcept {
  TaskState& state = *tasks_[position_];
  const std::int64_t start = current_start_.load(std::memory_order_relaxed);
  const std::int64_t end = rt::to_ns(kernel_.now());
  times_[position_] = {release_ns_, start, end};
  trace_.module.store(static_cast<std::int32_t>(state.task.index), std::memory_order_relaxed);
  trace_.exec_ns.store(end - start, std::memory_order_relaxed);
  current_start_.store(end, std::memory_order_relaxed);
  quarantine(state, kind, tick_, text, hooks_);
  call_end_hook(true);
}

// Time spent in the hook is not counted as execution time, unless reading the clock would take longer.
void Runner::call_begin_hook() noexcept {
  if (hooks_.begins != nullptr && hooks_.begins(hooks_.context, tasks_[position_]->task.index)) {
    hooks_were_slow_ = true;
  }
  if (hooks_were_slow_) {
    hooks_were_slow_ = false;
    current_start_.store(rt::to_ns(kernel_.now()), std::memory_order_relaxed);
  }
}

void Runner::call_end_hook(bool faulted) noexcept {
  if (hooks_.ended != nullptr) {
    hooks_were_slow_ = hooks_.ended(hooks_.context, tasks_[position_]->task.index, tick_, times_[position_], faulted);
  }
}

void Runner::account() noexcept {
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    const RunTimes& times = times_[i];
    if (times.end_ns != 0) {
      account_run(*tasks_[i]->record, tasks_[i]->jitter, times);
      if (tasks_[i]->logged) {
        log_slot(block_, {tick_, tasks_[i]->task.index, times});
      }
    }
  }
}

void Runner::enforce_budget(rt::MonoTime now, bool stopping, std::int64_t grace_ns, std::int64_t late_ns) noexcept {
  if (!attached_.load(std::memory_order_acquire) || !guard_.armed()) {
    return;
  }
  const std::uint64_t run = guard_.current_run();
  const TaskState* state = current();
  const std::int64_t start = current_start();
  if (state == nullptr) {
    return;
  }
  std::int64_t limit = state->task.budget_ns;
  const bool limited = limit > 0 || stopping;
  if (stopping && (limit == 0 || limit > grace_ns)) {
    limit = grace_ns;
  }
  const std::int64_t lasts = rt::to_ns(now) - start;
  if (late_ns > 0) {
    const std::int64_t before =
        excused_run_.load(std::memory_order_relaxed) == run ? excused_ns_.load(std::memory_order_relaxed) : 0;
    excused_ns_.store(before + std::clamp<std::int64_t>(late_ns, 0, std::max<std::int64_t>(lasts, 0)),
                      std::memory_order_relaxed);
    excused_run_.store(run, std::memory_order_release);
  }
  const std::int64_t excused =
      excused_run_.load(std::memory_order_acquire) == run ? excused_ns_.load(std::memory_order_relaxed) : 0;
  if (limited && lasts - excused > limit) {
    guard_.order_end(thread_.handle, run);
  }
}

}  // namespace indurop::scheduler
