// SPDX-License-Identifier: Apache-2.0
#include "scheduler/band.h"

#include <algorithm>
#include <csignal>
#include <utility>

#include "core/rt/relaxed.h"

namespace indurop::scheduler {
namespace {

using rt::kRelaxed;
constexpr std::chrono::microseconds kPoll{50};  // how often a process that must finish first is polled

}  // namespace

Band::Band(const BandPlan& plan, std::vector<TaskState*> tasks, std::vector<TaskState*> processes, RunBlock& block,
           Kernel& kernel, const Hooks& hooks, CoreTrace& trace, std::int64_t basic_period_ns)
    : plan_(plan),
      tasks_(std::move(tasks)),
      processes_(std::move(processes)),
      block_(block),
      kernel_(kernel),
      hooks_(hooks),
      trace_(trace),
      runner_(block, kernel, hooks, trace, tasks_.size()),
      basic_period_ns_(basic_period_ns),
      grid_{static_cast<std::uint64_t>(plan.period_ns / basic_period_ns),
            static_cast<std::uint64_t>(plan.offset_ns / basic_period_ns)},
      next_due_(grid_.offset) {
  wake_.init(false);
  arrived_.resize(tasks_.size());
}

bool is_leaving(const TaskState& state) noexcept {
  const Band* band = state.leaving.load(std::memory_order_seq_cst);
  return band != nullptr && !band->has_done(band->released());
}

bool Band::any_enabled() const noexcept {
  for (const TaskState* state : tasks_) {
    if (!state->is_closed()) {
      return true;
    }
  }
  return !processes_.empty();
}

// Returns true if releases have not been started yet, or, for threads, are not finished.
bool Band::outstanding() const noexcept {
  return done_.load(std::memory_order_seq_cst) != released_.load(std::memory_order_seq_cst);
}

bool Band::is_busy() const noexcept {
  if (outstanding()) {
    return true;
  }
  if (plan_.kind == BandKind::Process) {
    const ProcessSlot& slot = *tasks_.front()->slot;
    return slot.done.load(std::memory_order_acquire) != slot.released.load(std::memory_order_acquire);
  }
  return false;
}

std::uint64_t Band::activity() const noexcept {
  const bool process = plan_.kind == BandKind::Process;
  const auto& done_word = process ? tasks_.front()->slot->done : done_;
  const auto& released_word = process ? tasks_.front()->slot->released : released_;
  const std::uint64_t done = done_word.load(std::memory_order_acquire);
  return 2 * done + (released_word.load(std::memory_order_acquire) != done ? 1 : 0);
}

void Band::skip(TaskState& state, std::uint64_t releases) noexcept {
  if (state.task.operation == Operation::Periodic && !state.is_closed()) {
    count(state.record->skipped, releases);
  }
}

void Band::skip(std::uint64_t releases) noexcept {
  for (TaskState* state : tasks_) {
    skip(*state, releases);
  }
}

// Once the last run by the schedule before is over, no other begins.
std::span<TaskState* const> Band::tasks_to_run() noexcept {
  if (!some_leave_) [[likely]] {
    return tasks_;
  }
  std::size_t count = 0;
  for (TaskState* state : tasks_) {
    if (is_leaving(*state)) {
      skip(*state, 1);
    } else {
      arrived_[count++] = state;
    }
  }
  some_leave_ = count < tasks_.size();
  return std::span(arrived_).first(count);
}

void Band::release_due(std::uint64_t tick, rt::MonoTime epoch) noexcept {
  if (tick >= next_due_) {
    const std::uint64_t due_count = (tick - next_due_) / grid_.period + 1;
    const std::uint64_t latest = next_due_ + (due_count - 1) * grid_.period;
    next_due_ = latest + grid_.period;
    if (due_count > 1) {
      skip(due_count - 1);
    }
    if (any_enabled()) {
      release({latest, epoch + std::chrono::nanoseconds(static_cast<std::int64_t>(latest) * basic_period_ns_)});
    }
  }
  decided_tick_.store(tick + 1, std::memory_order_seq_cst);
}

void Band::miss_due(std::uint64_t end_tick) noexcept {
  if (end_tick > next_due_) {
    skip((end_tick - 1 - next_due_) / grid_.period + 1);
    next_due_ = end_tick;
  }
}

void Band::leave_at(std::uint64_t tick) noexcept {
  miss_due(tick);
  skip(std::exchange(owed_, 0));
  decided_tick_.store(tick, std::memory_order_seq_cst);
}

void Band::begin_at(std::uint64_t tick) noexcept {
  const std::uint64_t since = tick > grid_.offset ? tick - grid_.offset : 0;
  next_due_ = grid_.offset + (since + grid_.period - 1) / grid_.period * grid_.period;
  some_leave_ = std::any_of(tasks_.begin(), tasks_.end(), [](const TaskState* state) { return is_leaving(*state); });
}

void Band::release(const Release& release) noexcept {
  if (plan_.kind == BandKind::Process && tasks_to_run().empty()) {
    return;
  }
  if (plan_.kind == BandKind::Process && !waits_for_others()) {
    release_process(*tasks_.front(), release);
    return;
  }
  if (outstanding()) {
    if (plan_.kind == BandKind::Handler) {
      return;  // still checking the events of an earlier tick: one check serves both
    }
    overrun(release);
    const std::uint64_t outstanding = released_.load(kRelaxed) - done_.load(std::memory_order_acquire);
    if (plan_.overrun != OverrunPolicy::CatchUp || outstanding >= kBacklog) {
      skip(1);
      return;
    }
  }
  const std::uint64_t number = released_.load(kRelaxed);
  pending_[number % kBacklog] = release;
  released_.store(number + 1, std::memory_order_seq_cst);
  wake_.wake();
}

void Band::account_process(TaskState& state) noexcept {
  ProcessSlot& slot = *state.slot;
  const std::uint64_t done = slot.done.load(std::memory_order_acquire);
  if (done == state.accounted || done != slot.released.load(kRelaxed)) {
    return;
  }
  state.accounted = done;
  const RunTimes times{slot.release_ns.load(kRelaxed), slot.start_ns.load(kRelaxed), slot.end_ns.load(kRelaxed)};
  if (times.end_ns < times.start_ns || times.start_ns < times.release_ns) {
    return;  // the process was restarted in between
  }
  account_run(*state.record, state.jitter, times);
  trace_.module.store(static_cast<std::int32_t>(state.task.index), kRelaxed);
  trace_.exec_ns.store(times.end_ns - times.start_ns, kRelaxed);
  log_slot(block_, {slot.release_tick.load(kRelaxed), state.task.index, times});
}

void Band::release_process(TaskState& state, const Release& release) noexcept {
  ModuleRecord& record = *state.record;
  const std::int32_t pid = record.pid.load(kRelaxed);
  if (record.state.load(std::memory_order_acquire) != ModuleState::Running || pid <= 0) {
    const bool missed = record.state.load(kRelaxed) != ModuleState::Stopped;
    if (state.task.operation == Operation::Periodic && record.runs.load(kRelaxed) > 0 && missed) {
      count(record.skipped);
    }
    return;
  }
  if (state.task.legacy_signal != 0) {
    kernel_.wake_process(state.task, *state.slot, record);
    count(record.runs);
    return;
  }
  ProcessSlot& slot = *state.slot;
  if (slot.done.load(std::memory_order_acquire) != slot.released.load(kRelaxed)) {
    if (state.task.operation == Operation::Sporadic) {
      count(record.skipped);  // it is still handling an event; its deadline is checked when it is done
      return;
    }
    const bool started = slot.start_ns.load(kRelaxed) >= slot.release_ns.load(kRelaxed);
    record_overrun(state, release.tick, started, slot.release_ns.load(kRelaxed));
    count(record.skipped);  // a process has one release slot: missed releases cannot be caught up
    return;
  }
  account_process(state);
  slot.release_ns.store(rt::to_ns(release.time), kRelaxed);
  slot.release_tick.store(release.tick, kRelaxed);
  slot.released.store(slot.released.load(kRelaxed) + 1, std::memory_order_release);
  kernel_.wake_process(state.task, slot, record);
}

void Band::run_inline(std::uint64_t tick, rt::MonoTime release, std::uint64_t lost) noexcept {
  if (lost > 0) {
    if (plan_.overrun == OverrunPolicy::CatchUp) {
      const std::uint64_t over = owed_ + lost > kBacklog ? owed_ + lost - kBacklog : 0;
      owed_ += lost - over;
      skip(over);
    } else {
      skip(lost);
    }
  }
  released_.store(released_.load(kRelaxed) + 1, std::memory_order_seq_cst);
  running_ = tasks_to_run();
  runner_.run(running_, tick, release);
  find_inline_overrun(tick, rt::to_ns(release));
  for (; owed_ > 0 && kernel_.now() < release + std::chrono::nanoseconds(basic_period_ns_); --owed_) {
    runner_.run(running_, tick, release);
  }
  done_.store(released_.load(kRelaxed), std::memory_order_seq_cst);
  next_due_ = tick + 1;
  decided_tick_.store(tick + 1, std::memory_order_seq_cst);
}

bool Band::gate_open(std::uint64_t tick, bool& poll) const noexcept {
  poll = false;
  for (std::size_t i = predecessors_.size(); i-- > 0;) {
    const Band& before = *predecessors_[i];
    if (!before.due(tick)) {
      continue;
    }
    // All of them: two of equal priority on two cores do not wait for one another.
    if (before.decided_tick_.load(std::memory_order_seq_cst) <= tick || before.is_busy()) {
      poll = before.plan_.kind == BandKind::Process;
      return false;
    }
  }
  return true;
}

void Band::loop() noexcept {
  runner_.attach_thread();
  while (!stop_.load(std::memory_order_acquire)) {
    kernel_.wait(wake_);
    drain();
  }
  runner_.detach_thread();
}

void Band::drain() noexcept {
  while (!stop_.load(std::memory_order_acquire) && outstanding()) {
    const std::uint64_t number = done_.load(kRelaxed);
    const Release now = pending_[number % kBacklog];
    bool poll = false;
    waiting_.store(true, std::memory_order_seq_cst);
    const bool open = gate_open(now.tick, poll);
    if (!open && !poll) {
      return;  // check_again() wakes us
    }
    waiting_.store(false, std::memory_order_seq_cst);
    if (!open) {
      kernel_.sleep_until(kernel_.now() + kPoll);
      continue;
    }
    if (plan_.kind == BandKind::Process) {
      release_process(*tasks_.front(), now);
    } else {
      running_ = tasks_to_run();
      runner_.run(running_, now.tick, now.time);
    }
    for (TaskState* process : processes_) {
      release_process(*process, now);
    }
    done_.store(number + 1, std::memory_order_seq_cst);
    if (on_done_.function != nullptr) {
      on_done_.function(on_done_.context);
    }
    if (hooks_.worked != nullptr) {
      hooks_.worked(hooks_.context);
    }
  }
}

void Band::stop() noexcept {
  stop_.store(true, std::memory_order_release);
  wake_.wake();
}

void Band::check_again() noexcept {
  if (waiting_.exchange(false, std::memory_order_seq_cst)) {
    wake_.wake();
  }
}

void Band::finish() noexcept {
  for (const auto* group : {&tasks_, &processes_}) {
    for (TaskState* state : *group) {
      if (state->task.type == ModuleType::Process) {
        account_process(*state);
      }
      state->jitter.flush(state->record->jitter);
    }
  }
}

}  // namespace indurop::scheduler
