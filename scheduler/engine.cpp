// SPDX-License-Identifier: Apache-2.0
// How a tick proceeds. Each core has one tick thread, which sleeps until the absolute time of the next tick; missed
// ticks are counted and not made up for. It runs the band at the top of its core itself and releases the other bands
// that are due: threads with lower FIFO priorities, so that a quick band preempts a slow one. Where these priorities do
// not give the order (several cores, data flow), a band waits for its predecessors. Sporadic modules run after all
// periodic ones, or directly after the base modules. A watchdog ends runs that exceed their budget.
#include "scheduler/engine.h"

#include <algorithm>
#include <utility>

#include "scheduler/engine_core.h"
#include "scheduler/execution_order.h"
#include "scheduler/late_ticks.h"
#include "scheduler/run_block_setup.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kWarmUpNs = 20'000'000;
constexpr std::int64_t kLeadNs = 2'000'000;  // between creating the threads and the first warm-up tick
constexpr std::chrono::milliseconds kEndPoll{1};

// Whole basic periods, at least three, in which the tick threads wake up and no module runs.
std::int64_t warm_up_ns(std::int64_t basic_period_ns) noexcept {
  return std::max<std::int64_t>(kWarmUpNs / basic_period_ns, 3) * basic_period_ns;
}

std::int64_t epoch_of(const RunBlock& block) noexcept {
  return block.epoch_ns.load(std::memory_order_relaxed);
}

}  // namespace

Schedule::Parts Engine::schedule_parts() {
  return {block_, kernel_, hooks_, settings_, [this](int number) -> CoreTrace& { return core(number).trace; }};
}

Engine::Engine(RunBlock& block, std::span<const Task> tasks, const EngineSettings& settings, const Hooks& hooks,
               Kernel& kernel)
    : block_(block), settings_(settings), hooks_(hooks), kernel_(kernel) {
  core(settings_.primary_core).primary = true;
  states_.reserve(tasks.size() + kSpareModules);  // halt() may be called from a signal handler while one is added
  std::vector<Member> members;
  for (const Task& task : tasks) {
    add_state(task);
    members.push_back({task, states_.back().get(), nullptr});
  }
  schedule_ = std::make_unique<Schedule>(schedule_parts(), std::move(members));
  schedule_->publish_priorities();
  for (const auto& core : cores_) {
    core->bands = &schedule_->on(core->number);
  }
  watched_[0].store(schedule_.get());
}

void Engine::add_state(const Task& task) {
  auto state = std::make_unique<TaskState>();
  state->task = task;
  state->record = &block_.modules()[task.index];
  state->slot = &block_.process_slots()[task.index];
  states_.push_back(std::move(state));
}

Engine::~Engine() {
  request_stop();
  join();
}

void Engine::halt() noexcept {
  for (const auto& state : states_) {
    state->gate.store(Gate::Closed, std::memory_order_seq_cst);
  }
  request_stop();
}

Engine::Core& Engine::core(int number) {
  for (const auto& known : cores_) {
    if (known->number == number) {
      return *known;
    }
  }
  cores_.push_back(std::make_unique<Core>());
  cores_.back()->number = number;
  return *cores_.back();
}

Status Engine::start_watchdog() {
  rt::ThreadSettings settings;
  settings.name = "irp-watchdog";
  settings.stack_bytes = std::size_t{128} * 1024;  // it only checks
  settings.fifo_priority = settings_.realtime ? kWatchdogPriority : 0;
  const auto allowed = rt::allowed_cores();
  // On another core, if there is one, its wake-ups cannot delay a tick.
  const auto other = std::find_if(allowed.begin(), allowed.end(), [&](int number) {
    return std::none_of(cores_.begin(), cores_.end(), [&](const auto& used) { return used->number == number; });
  });
  settings.core = other != allowed.end() ? *other : -1;
  auto watchdog = kernel_.start(settings, [this] { watchdog_loop(); });
  if (!watchdog) {
    return watchdog.error();
  }
  watchdog_ = std::move(watchdog).value();
  return {};
}

Status Engine::start(std::uint64_t ticks) {
  rt::install_guard_handlers();
  if (Status started = schedule_->start_threads(); !started) {
    request_stop();
    join();
    return started;
  }
  std::int64_t epoch = rt::to_ns(kernel_.now()) + kLeadNs + warm_up_ns(settings_.basic_period_ns);
  if (settings_.grid_ns > 0) {
    const std::int64_t past = (epoch - settings_.phase_ns) % settings_.grid_ns;
    epoch += past > 0 ? settings_.grid_ns - past : -past;
  }
  block_.epoch_ns = epoch;
  if (Status started = start_watchdog(); !started) {
    request_stop();
    join();
    return started;
  }
  ticking_.store(static_cast<int>(cores_.size()), std::memory_order_release);
  for (const auto& core : cores_) {
    rt::ThreadSettings settings;
    settings.name = "irp-tick-" + std::to_string(core->number);
    settings.fifo_priority = settings_.realtime ? kTickPriority : 0;
    settings.core = settings_.realtime ? core->number : -1;
    settings.runs_modules = true;
    auto thread = kernel_.start(settings, [this, &core = *core, ticks] { tick_loop(core, ticks); });
    if (!thread) {
      request_stop();
      ticking_.store(0, std::memory_order_release);
      join();
      return thread.error();
    }
    threads_.push_back(std::move(thread).value());
  }
  return {};
}

void Engine::tick_loop(Core& core, std::uint64_t ticks) noexcept {
  if (!settings_.realtime) {
    rt::request_exact_timers();
  }
  core.thread = ModuleThread::own();
  for (Band* band : core.bands->here) {
    band->runner().attach(*core.thread);
  }
  const std::int64_t basic = settings_.basic_period_ns;
  TickWait wait(kernel_, settings_.spin, basic);
  for (std::int64_t t = epoch_of(block_) - warm_up_ns(basic); t < epoch_of(block_); t += basic) {
    wait.wait_until(rt::mono_time(t));
  }
  std::uint64_t missed = 0;  // ticks since the last one that was run
  LateTicks late_ticks(basic);
  for (std::uint64_t tick = 0; !stop_.load(std::memory_order_acquire); ++tick) {
    const std::int64_t planned = epoch_of(block_) + static_cast<std::int64_t>(tick) * basic;
    const std::int64_t begin = rt::to_ns(wait.wait_until(rt::mono_time(planned)));
    const std::int64_t late = begin - planned;
    const LateTicks::Start start = late_ticks.start(late);
    if (ticks != 0 && tick + start.lost() >= ticks) {
      end_run(core, ticks, ticks - tick);
      break;
    }
    tick += start.passed;
    missed += start.lost();
    if (core.primary) {
      LateTicks::count(block_, late, start);
      block_.spin_margin_ns.store(wait.margin_ns(), std::memory_order_relaxed);
    }
    if (!start.in_vain) {
      do_tick(core, tick, std::exchange(missed, 0));
      late_ticks.add_work(rt::to_ns(kernel_.now()) - begin);
    }
  }
  for (Band* band : core.bands->here) {
    band->runner().detach_thread();
  }
  ticking_.fetch_sub(1, std::memory_order_acq_rel);
}

void Engine::end_run(Core& core, std::uint64_t ticks, std::uint64_t lost) noexcept {
  if (core.primary) {
    block_.lost_ticks.fetch_add(lost, std::memory_order_relaxed);
    block_.tick.store(ticks, std::memory_order_release);
  }
  for (const auto* bands : {&core.bands->here, &core.bands->released}) {
    for (Band* band : *bands) {
      band->miss_due(ticks);
    }
  }
}

void Engine::do_tick(Core& core, std::uint64_t tick, std::uint64_t lost) noexcept {
  core.begun.store(tick + 1, std::memory_order_seq_cst);
  if (proposal_.is_there()) [[unlikely]] {
    lost = follow(core, tick, lost);
  }
  const rt::MonoTime epoch = rt::mono_time(epoch_of(block_));
  const auto since = std::chrono::nanoseconds(static_cast<std::int64_t>(tick) * settings_.basic_period_ns);
  if (core.primary) {
    block_.tick.store(tick + 1, std::memory_order_release);
    if (hooks_.ticks != nullptr) {
      hooks_.ticks(hooks_.context, tick, rt::to_ns(epoch + since));
    }
  }
  for (Band* band : core.bands->here) {
    band->run_inline(tick, epoch + since, lost);
  }
  for (Band* band : core.bands->released) {
    band->release_due(tick, epoch);
  }
  if (core.bands->schedule->is_gated()) {
    core.bands->schedule->wake_waiting();
  }
  if ((core.primary || !core.bands->here.empty()) && hooks_.worked != nullptr) {
    hooks_.worked(hooks_.context);
  }
}

void Engine::step(std::uint64_t tick, rt::MonoTime epoch) noexcept {
  block_.epoch_ns = rt::to_ns(epoch);
  for (const auto& core : cores_) {
    do_tick(*core, tick, 0);
  }
  for (const Schedule* schedule : {retirement_.schedule(), schedule_.get(), next_.get()}) {
    if (schedule != nullptr) {
      schedule->drain();
    }
  }
}

void Engine::watchdog_loop() noexcept {
  while (!stop_watchdog_.load(std::memory_order_acquire)) {
    std::int64_t period = watched_[0].load(std::memory_order_acquire)->watchdog_period();
    if (const Schedule* other = watched_[1].load(std::memory_order_acquire); other != nullptr) {
      period = std::min(period, other->watchdog_period());
    }
    watchdog_passes_.fetch_add(1, std::memory_order_acq_rel);
    // Half a basic period after a tick, where the wake-up delays no tick if they share a core.
    const std::int64_t grid = period >= settings_.basic_period_ns ? settings_.basic_period_ns : period;
    const std::int64_t earliest = rt::to_ns(kernel_.now()) + period - epoch_of(block_);
    const rt::MonoTime planned = rt::mono_time(epoch_of(block_) + (earliest / grid) * grid + grid / 2);
    kernel_.sleep_until(planned);
    const rt::MonoTime now = kernel_.now();
    const std::int64_t late_ns = std::max<std::int64_t>(rt::to_ns(now) - rt::to_ns(planned), 0);
    if (settings_.stalled_ns != nullptr) {
      settings_.stalled_ns->fetch_add(late_ns, std::memory_order_relaxed);
    }
    const bool stopping = stop_.load(std::memory_order_acquire);
    for (const auto& watched : watched_) {
      if (const Schedule* schedule = watched.load(std::memory_order_acquire); schedule != nullptr) {
        schedule->enforce_budgets(now, stopping, settings_.stop_grace_ns, late_ns);
      }
    }
  }
}

void Engine::join() noexcept {
  // A run that ended on its own (ticks) stops its bands, too.
  while (!finished() && !stop_.load(std::memory_order_acquire)) {
    kernel_.sleep_until(kernel_.now() + kEndPoll);
  }
  stop_.store(true, std::memory_order_release);
  const std::array<Schedule*, 3> all{retirement_.schedule(), schedule_.get(), next_.get()};
  const auto each = [&all](auto&& act) {
    for (Schedule* schedule : all) {
      if (schedule != nullptr) {
        act(*schedule);
      }
    }
  };
  each([](Schedule& one) { one.request_stop(); });
  for (const auto& thread : threads_) {
    thread->join();
  }
  threads_.clear();
  each([](Schedule& one) { one.join(); });
  stop_watchdog_.store(true, std::memory_order_release);
  if (watchdog_ != nullptr) {
    watchdog_->join();
  }
  each([](Schedule& one) { one.finish(); });
}

}  // namespace indurop::scheduler
