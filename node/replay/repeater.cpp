// SPDX-License-Identifier: Apache-2.0
#include "node/replay/repeater.h"

#include <algorithm>
#include <utility>

#include "core/rt/processor_time.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;
using scheduler::ModuleType;

constexpr std::chrono::seconds kReplayPatience{10};  // for a process, in real time
constexpr std::chrono::microseconds kReplayPoll{50};

}  // namespace

void Repeater::Kernel::set(std::int64_t ns) noexcept {
  for (auto* shown : shown_) {
    shown->store(ns, std::memory_order_relaxed);
  }
}

Repeater::Repeater(const Options& options, Console& console, base::StopSignal& signals, const Checked& checked,
                   const Prepared& prepared, const Loaded& loaded)
    : options_(options),
      console_(console),
      signals_(signals),
      store_(*prepared.store),
      libraries_(loaded.libraries),
      run_(prepared.run()),
      kernel_({&prepared.store->virtual_time(), &run_.virtual_ns}),
      runner_(run_, kernel_, run_hooks(), trace_, 1),
      phases_(checked.config, run_, loaded.libraries, console, signals, hooks(), kernel_),
      processes_(checked.config, run_, options.node, false, console, *prepared.failsafe, nullptr) {
  kernel_.set(rt::kNanosPerSecond);
}

scheduler::Hooks Repeater::hooks() {
  scheduler::Hooks hooks;
  hooks.context = this;
  hooks.entering = [](void*, std::uint32_t module, std::uint64_t, std::int64_t) noexcept {
    runtime::set_current_module(module);
  };
  hooks.faulted = [](void* context, std::uint32_t /*module*/) noexcept {
    static_cast<Repeater*>(context)->store_.release_locks_of_this_thread();
    runtime::release_calls_of_this_thread();
  };
  return hooks;
}

scheduler::Hooks Repeater::run_hooks() {
  scheduler::Hooks hooks = this->hooks();
  hooks.entering = [](void*, std::uint32_t module, std::uint64_t tick, std::int64_t release_ns) noexcept {
    runtime::set_current_run(module, {tick, release_ns});
  };
  return hooks;
}

bool Repeater::prepare_processes() {
  auto input = tape::ReplayInputWriter::create(options_.node, run_.node_pid.load());
  if (!input) {
    console_.error("the recorded inputs cannot be passed to process modules: {}", describe(input.error()));
    return false;
  }
  replay_input_.emplace(std::move(input).value());
  return true;
}

void Repeater::attach() {
  rt::install_guard_handlers();
  runner_.attach_thread();
  if (options_.replay.stop_tick != config::Replay::kLastTick) {
    return;  // time passes while a debugger has stopped a run
  }
  hang_watch_.emplace([this] { return returned_.load(std::memory_order_relaxed); },
                      [this] { runner_.enforce_budget(kernel_.now() + kReplayPatience, true, 0); });
}

bool Repeater::start(const ReplayedModules& modules) {
  for (const auto& module : modules.all()) {
    if (!module->runs) {
      run_.modules()[module->index].state.store(ModuleState::Stopped);
    }
  }
  const bool started = phases_.call_all("start", &ModuleDescriptor::start);
  console_.report(rt::MonoClock::now(), false);  // the reason, before the node ends
  if (!started) {
    console_.error("a module could not be started: nothing was run");
    return false;
  }
  if (const Status served = runtime::start_function_servers(0, -1); !served) {
    console_.error("shared functions cannot be served: {}", describe(served.error()));
    return false;
  }
  for (const auto& module : modules.all()) {
    if (module->runs && module->is_process() && !processes_.start(module->index)) {
      return false;
    }
  }
  const rt::MonoTime until = rt::MonoClock::now() + kReplayPatience;
  while (!processes_.ready() && rt::MonoClock::now() < until && signals_.wait(kReplayPoll) == 0) {
    (void)processes_.supervise(rt::MonoClock::now(), kernel_.now());
  }
  for (const auto& module : modules.all()) {
    find_kept(*module);
    if (module->runs && module->state.task.type == ModuleType::Thread) {
      module->state.record->state.store(ModuleState::Running);
    }
  }
  run_.state.store(scheduler::NodeState::Running);
  return true;
}

bool Repeater::repeat(ReplayedModule& module, const recorder::RunWords& run) {
  run_.epoch_ns = run.tail.release_ns - static_cast<std::int64_t>(run.tail.tick) * run_.basic_period_ns;
  run_.tick.store(run.tail.tick + 1);
  // A module that polls the clock waits for a time: after its recorded clock readings, that time has come.
  kernel_.set(module.clock.size() < std::size_t{tape::kMaxReadings} ? run.tail.start_ns : run.tail.end_ns);
  module.write_inputs(store_);
  if (std::exchange(module.restart_due, false)) {
    if (!restart(module)) {
      return false;
    }
    module.write_inputs(store_);  // its start may have written variables
  }
  if (std::exchange(module.restores, false)) {
    restore(module);
  }
  if (module.is_process()) {
    const std::int64_t before_ns = rt::process_time_ns(processes_.pid(module.index));
    run_process(module, run.tail);
    module.busy_ns = std::max<std::int64_t>(0, rt::process_time_ns(processes_.pid(module.index)) - before_ns);
  } else {
    scheduler::TaskState* state = &module.state;
    const std::vector<tape::ReplayedAnswer> answers = module.replayed_answers();
    runtime::set_clock_readings(module.clock);
    runtime::set_answers(answers);
    const std::int64_t before_ns = rt::thread_time_ns();
    runner_.run({&state, 1}, run.tail.tick, rt::mono_time(run.tail.release_ns));
    module.busy_ns = rt::thread_time_ns() - before_ns;
    runtime::set_clock_readings({});
    runtime::set_answers({});
  }
  returned_.fetch_add(1, std::memory_order_relaxed);
  return true;
}

void Repeater::stop() {
  runner_.detach_thread();
  run_.state.store(scheduler::NodeState::Stopping);
  processes_.end_all();
  runtime::stop_function_servers();
  (void)phases_.call_all("stop", &ModuleDescriptor::stop);
  hang_watch_.reset();
}

}  // namespace indurop::node
