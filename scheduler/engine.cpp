// SPDX-License-Identifier: Apache-2.0
// How a tick proceeds. Each core has one tick thread, which sleeps until the absolute time of the next tick; missed
// ticks are counted and not made up for. It runs the band at the top of its core itself and releases the other bands
// that are due: threads with lower FIFO priorities, so that a quick band preempts a slow one. Where these priorities do
// not give the order (several cores, data flow), a band waits for its predecessors. Sporadic modules run after all
// periodic ones, or directly after the base modules. A watchdog ends runs that exceed their budget.
#include "scheduler/engine.h"

#include <algorithm>
#include <utility>

#include "scheduler/execution_order.h"
#include "scheduler/late_ticks.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kWarmUpNs = 20'000'000;
constexpr std::int64_t kLeadNs = 2'000'000;  // between creating the threads and the first warm-up tick
constexpr std::int64_t kWatchdogFastest = 1'000'000;
constexpr std::int64_t kWatchdogSlowest = 10'000'000;

// Whole basic periods, at least three, in which the tick threads wake up and no module runs.
std::int64_t warm_up_ns(std::int64_t basic_period_ns) noexcept {
  return std::max<std::int64_t>(kWarmUpNs / basic_period_ns, 3) * basic_period_ns;
}

bool data_flows(const Band& from, const Band& to) noexcept {
  const auto waits = [&](const TaskState* earlier, const TaskState* later) {
    const auto& after = later->task.after;
    return std::find(after.begin(), after.end(), earlier->task.index) != after.end();
  };
  return std::any_of(to.tasks().begin(), to.tasks().end(), [&](const TaskState* later) {
    return std::any_of(from.tasks().begin(), from.tasks().end(),
                       [&](const TaskState* earlier) { return waits(earlier, later); });
  });
}

// Returns true if `band` must wait for `other`. Event handling waits for all periodic bands; bands handled directly
// after the base modules neither wait for others nor are waited for.
bool comes_before(const Band& other, const Band& band, CoreOrder order) noexcept {
  if (other.plan().kind == BandKind::AfterBase || band.plan().kind == BandKind::AfterBase) {
    return false;
  }
  if (band.plan().kind == BandKind::Handler || other.tasks().empty() || other.plan().core == band.plan().core) {
    return true;
  }
  return order == CoreOrder::Data ? data_flows(other, band)
                                  : other.tasks().front()->task.priority < band.tasks().front()->task.priority;
}

}  // namespace

struct Engine::Core {
  int number = 0;
  bool primary = false;
  CoreTrace trace;
  std::vector<Band*> here;      // run in this core's tick thread, execution order
  std::vector<Band*> released;  // released by this core's tick thread, execution order
};

Engine::Engine(RunBlock& block, std::span<const Task> tasks, const EngineSettings& settings, const Hooks& hooks,
               Kernel& kernel)
    : block_(block), settings_(settings), hooks_(hooks), kernel_(kernel) {
  core(settings_.primary_core).primary = true;
  std::vector<TaskState*> periodic;
  std::vector<TaskState*> sporadic;
  for (const Task& task : tasks) {
    auto state = std::make_unique<TaskState>();
    state->task = task;
    state->record = &block_.modules()[task.index];
    state->slot = &block_.process_slots()[task.index];
    if (task.operation == Operation::Periodic) {
      periodic.push_back(state.get());
    } else if (task.operation == Operation::Sporadic) {
      sporadic.push_back(state.get());
    }
    states_.push_back(std::move(state));
  }
  build_periodic(periodic);
  build_sporadic(sporadic);
  gated_ = !settings_.realtime || cores_.size() > 1;  // NOLINT(*-prefer-member-initializer): the bands make cores_
  connect_predecessors();
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

void Engine::add_band(const BandPlan& plan, std::vector<TaskState*> tasks, std::vector<TaskState*> processes) {
  Core& home = core(plan.core);
  for (const TaskState* state : tasks) {
    state->record->fifo_priority = settings_.realtime ? plan.fifo_priority : 0;
  }
  for (const TaskState* state : processes) {
    state->record->fifo_priority = settings_.realtime ? kSporadicProcessPriority : 0;
  }
  bands_.push_back(std::make_unique<Band>(plan, std::move(tasks), std::move(processes), block_, kernel_, hooks_,
                                          home.trace, settings_.basic_period_ns));
  (in_tick_thread(plan.kind) ? home.here : home.released).push_back(bands_.back().get());
}

void Engine::build_periodic(const std::vector<TaskState*>& periodic) {
  std::vector<Task> plain;
  plain.reserve(periodic.size());
  for (const TaskState* state : periodic) {
    plain.push_back(state->task);
  }
  for (const BandPlan& plan : make_bands(plain, settings_.basic_period_ns, settings_.order)) {
    std::vector<TaskState*> members;
    for (const std::uint32_t i : plan.tasks) {
      members.push_back(periodic[i]);
    }
    add_band(plan, std::move(members));
  }
}

void Engine::build_sporadic(const std::vector<TaskState*>& sporadic) {
  std::vector<TaskState*> early;
  std::vector<TaskState*> threads;
  std::vector<TaskState*> processes;
  for (const std::uint32_t i :
       execution_order(sporadic.size(), [&](std::uint32_t task) { return sporadic[task]->task.priority; })) {
    const Task& task = sporadic[i]->task;
    (task.type == ModuleType::Process ? processes : task.after_base ? early : threads).push_back(sporadic[i]);
  }
  BandPlan plan;
  plan.core = settings_.primary_core;
  plan.period_ns = settings_.basic_period_ns;
  if (!early.empty()) {
    plan.kind = BandKind::AfterBase;
    plan.fifo_priority = kTickPriority;
    add_band(plan, std::move(early));
  }
  if (!threads.empty() || !processes.empty()) {
    plan.kind = BandKind::Handler;
    plan.fifo_priority = kHandlerPriority;
    add_band(plan, std::move(threads), std::move(processes));
  }
}

// Needed only where FIFO priorities of one core do not already give the order: several cores, no real-time rights, or a
// band that waits for another core and so lets later ones pass.
void Engine::connect_predecessors() {
  if (!gated_) {
    return;
  }
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    Band& band = *bands_[i];
    std::vector<Band*> before;
    for (std::size_t k = 0; k < i; ++k) {
      Band& other = *bands_[k];
      const bool overtakes =
          other.waits_for_others() && (band.plan().kind == BandKind::Handler || data_flows(other, band));
      const bool priorities_suffice = settings_.realtime && other.plan().core == band.plan().core && !overtakes;
      if (comes_before(other, band, settings_.order) && !priorities_suffice) {
        before.push_back(&other);
      }
    }
    band.set_predecessors(std::move(before));
    band.set_done_callback([](void* self) noexcept { static_cast<Engine*>(self)->wake_waiting(); }, this);
  }
}

void Engine::wake_waiting() noexcept {
  for (const auto& band : bands_) {
    band->check_again();
  }
}

Status Engine::start_band_threads() {
  for (const auto& band : bands_) {
    const BandPlan& plan = band->plan();
    if (in_tick_thread(plan.kind) || (plan.kind == BandKind::Process && !band->waits_for_others())) {
      continue;
    }
    rt::ThreadSettings settings;
    settings.name = plan.kind == BandKind::Handler ? "irp-events" : "irp-band-" + std::to_string(plan.fifo_priority);
    settings.fifo_priority = settings_.realtime ? plan.fifo_priority : 0;
    settings.core = settings_.realtime ? plan.core : -1;
    settings.runs_modules = true;
    auto thread = kernel_.start(settings, [&band = *band] { band.loop(); });
    if (!thread) {
      return thread.error();
    }
    threads_.push_back(std::move(thread).value());
  }
  return {};
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
  if (Status started = start_band_threads(); !started) {
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
  for (Band* band : core.here) {
    band->runner().attach_thread();
  }
  const std::int64_t basic = settings_.basic_period_ns;
  TickWait wait(kernel_, settings_.spin, basic);
  for (std::int64_t t = epoch_ns() - warm_up_ns(basic); t < epoch_ns(); t += basic) {
    wait.wait_until(rt::mono_time(t));
  }
  std::uint64_t missed = 0;  // ticks since the last one that was run
  LateTicks late_ticks(basic);
  for (std::uint64_t tick = 0; !stop_.load(std::memory_order_acquire); ++tick) {
    const std::int64_t planned = epoch_ns() + static_cast<std::int64_t>(tick) * basic;
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
  for (Band* band : core.here) {
    band->runner().detach_thread();
  }
  ticking_.fetch_sub(1, std::memory_order_acq_rel);
}

void Engine::end_run(Core& core, std::uint64_t ticks, std::uint64_t lost) noexcept {
  if (core.primary) {
    block_.lost_ticks.fetch_add(lost, std::memory_order_relaxed);
    block_.tick.store(ticks, std::memory_order_release);
  }
  for (const auto* bands : {&core.here, &core.released}) {
    for (Band* band : *bands) {
      band->miss_due(ticks);
    }
  }
}

void Engine::do_tick(Core& core, std::uint64_t tick, std::uint64_t lost) noexcept {
  const rt::MonoTime epoch = rt::mono_time(epoch_ns());
  const auto since = std::chrono::nanoseconds(static_cast<std::int64_t>(tick) * settings_.basic_period_ns);
  if (core.primary) {
    block_.tick.store(tick + 1, std::memory_order_release);
    if (hooks_.ticks != nullptr) {
      hooks_.ticks(hooks_.context, tick, rt::to_ns(epoch + since));
    }
  }
  for (Band* band : core.here) {
    band->run_inline(tick, epoch + since, lost);
  }
  for (Band* band : core.released) {
    band->release_due(tick, epoch);
  }
  if (gated_) {
    wake_waiting();
  }
  if ((core.primary || !core.here.empty()) && hooks_.worked != nullptr) {
    hooks_.worked(hooks_.context);
  }
}

void Engine::step(std::uint64_t tick, rt::MonoTime epoch) noexcept {
  block_.epoch_ns = rt::to_ns(epoch);
  for (const auto& core : cores_) {
    do_tick(*core, tick, 0);
  }
  for (const auto& band : bands_) {
    if (!in_tick_thread(band->plan().kind)) {
      band->drain();
    }
  }
}

void Engine::watchdog_loop() noexcept {
  std::int64_t period = kWatchdogSlowest;
  for (const auto& state : states_) {
    if (state->task.budget_ns > 0) {
      period = std::min(period, std::max(state->task.budget_ns / 2, kWatchdogFastest));
    }
  }
  // Half a basic period after a tick, where the wake-up delays no tick if they share a core.
  const std::int64_t grid = period >= settings_.basic_period_ns ? settings_.basic_period_ns : period;
  while (!stop_watchdog_.load(std::memory_order_acquire)) {
    const std::int64_t earliest = rt::to_ns(kernel_.now()) + period - epoch_ns();
    kernel_.sleep_until(rt::mono_time(epoch_ns() + (earliest / grid) * grid + grid / 2));
    const rt::MonoTime now = kernel_.now();
    const bool stopping = stop_.load(std::memory_order_acquire);
    for (const auto& band : bands_) {
      band->runner().enforce_budget(now, stopping, settings_.stop_grace_ns);
    }
  }
}

void Engine::join() noexcept {
  // A run that ended on its own (ticks) stops its bands, too.
  while (!finished() && !stop_.load(std::memory_order_acquire)) {
    kernel_.sleep_until(kernel_.now() + std::chrono::nanoseconds(kWatchdogFastest));
  }
  stop_.store(true, std::memory_order_release);
  for (const auto& band : bands_) {
    band->stop();
  }
  for (const auto& thread : threads_) {
    thread->join();
  }
  threads_.clear();
  stop_watchdog_.store(true, std::memory_order_release);
  if (watchdog_ != nullptr) {
    watchdog_->join();
  }
  for (const auto& band : bands_) {
    band->finish();
  }
}

}  // namespace indurop::scheduler
