// SPDX-License-Identifier: Apache-2.0
#include "node/run/running.h"

#include <algorithm>
#include <csignal>
#include <cstring>

#include "core/rt/clock.h"
#include "node/modules/expected_signal.h"
#include "node/parts/facts_part.h"
#include "node/parts/plant_part.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;
using scheduler::ModuleType;

constexpr std::chrono::milliseconds kEndCheck{10};
constexpr std::chrono::milliseconds kEnrol{500};        // how long the first tick waits for process modules
constexpr std::chrono::seconds kEnrolInSimulation{10};  // the same in a simulation, also for one that was restarted

scheduler::SpinSettings to_spin(const config::SpinSetting& setting) {
  switch (setting.mode) {
    case config::SpinSetting::Mode::Off:
      return {scheduler::SpinMode::Off, 0};
    case config::SpinSetting::Mode::Fixed:
      return {scheduler::SpinMode::Fixed, setting.fixed.count()};
    case config::SpinSetting::Mode::Auto:
      break;
  }
  return {};
}

}  // namespace

Running::Running(const Options& options, Console& console, base::StopSignal& signals, Checked& checked,
                 Prepared& prepared, Loaded& loaded)
    : options_(options),
      console_(console),
      signals_(signals),
      checked_(checked),
      prepared_(prepared),
      run_(prepared.run()),
      loaded_(loaded),
      kernel_(make_kernel()),
      forces_(options.node),
      mirror_(options, checked, prepared, console),
      engine_(run_, loaded.tasks, engine_settings(), hooks(), kernel_),
      memory_(options.node, prepared, engine_, console),
      phases_(checked.config, run_, loaded.libraries, console, signals, plain_hooks(), kernel_),
      normal_threads_(checked.config, run_, loaded.libraries, plain_hooks(), kernel_),
      processes_(checked.config, run_, options.node, prepared.rights.realtime(), console, *prepared.failsafe,
                 prepared.tape.get()),
      commands_(ModuleCommands::Parts{options, checked.config, run_, loaded.libraries, engine_, processes_,
                                      normal_threads_, phases_, *prepared.failsafe, console, prepared.tape.get(),
                                      placement(options, prepared.rights), checked.routes, mirror_},
                Exchanges::Parts{options.node, checked.config, run_, loaded.libraries, engine_, *prepared.store,
                                 console, processes_, normal_threads_, options.simulation.on, !checked.mirror,
                                 checked.external.is_wanted(), prepared.tape.get()},
                checked.check,
                Phases(checked.config, run_, loaded.libraries, console, signals, apart_hooks(), kernel_)) {}

scheduler::Kernel& Running::make_kernel() {
  if (!options_.simulation.on) {
    return system_;
  }
  scheduler::ProcessWatch watch;
  watch.patient = [this](const scheduler::ModuleRecord& module, std::chrono::nanoseconds so_long) {
    if (so_long > HangWatch::kTimeout) {
      processes_.kill_hanging(static_cast<std::uint32_t>(&module - run_.modules()));
    }
    (void)processes_.supervise(rt::MonoClock::now(), kernel_.now());
    return module.state.load() == ModuleState::Running && signals_.wait(std::chrono::nanoseconds{0}) == 0;
  };
  watch.at_rest = has_dealt_with;
  return simulation_.emplace(options_.simulation, *prepared_.store, run_, signals_, std::move(watch)).kernel();
}

scheduler::EngineSettings Running::engine_settings() {
  const scheduler::RunBlockSetup& setup = prepared_.setup;
  scheduler::EngineSettings settings;
  settings.basic_period_ns = setup.basic_period_ns;
  settings.primary_core = prepared_.rights.core;
  settings.order = checked_.config.order;
  settings.realtime = prepared_.rights.realtime() || simulation_;
  settings.spin = simulation_ ? scheduler::SpinSettings{scheduler::SpinMode::Off, 0}
                              : to_spin(spin_setting(options_, checked_.config));
  if (checked_.mirror) {
    // Boards with the same macro period begin it together, as far as their clocks agree. They do not wait for a long
    // one.
    settings.grid_ns = setup.macro_period_ns <= rt::kNanosPerSecond ? setup.macro_period_ns : setup.basic_period_ns;
    settings.phase_ns = simulation_ ? 0 : (rt::now_ns() - rt::wall_ns()) % settings.grid_ns;
  }
  settings.stalled_ns = &reported_.stalled_ns;
  return settings;
}

Result<void, Ending> Running::start() {
  keyframes_ = KeyframePart::begin(options_, prepared_, loaded_, engine_, console_);
  auto recording = RecordPart::begin(options_, checked_, prepared_, console_);
  if (!recording) {
    return std::move(recording).error();
  }
  recording_ = std::move(recording).value();
  if (!simulation_) {
    black_box_.emplace(options_, checked_, prepared_, mirror_, console_);
  }
  if (auto done = start_modules(); !done) {
    return done;
  }
  if (auto done = launch_processes(); !done) {
    return done;
  }
  return start_schedule();
}

Result<void, Ending> Running::start_modules() {
  prepared_.name.keep();  // from here on there is something to inspect
  const bool ok = phases_.call_all("start", &ModuleDescriptor::start);
  console_.report(rt::MonoClock::now(), false);
  started_ = true;
  if (auto ending = interruption(signals_)) {
    return *std::move(ending);
  }
  if (!ok) {
    console_.error("a module could not be started: nothing was run");
    return Ending{kFailed};
  }
  const Rights& rights = prepared_.rights;
  const int service = rights.realtime() ? scheduler::kServicePriority : 0;
  if (const Status served = runtime::start_function_servers(service, rights.realtime() ? rights.core : -1); !served) {
    console_.error("shared functions cannot be served: {}", describe(served.error()));
    return Ending{kFailed};
  }
  return {};
}

Result<void, Ending> Running::launch_processes() {
  if (!processes_.launch_all()) {
    return Ending{kFailed};
  }
  if (!await_processes(rt::MonoClock::now() + (simulation_ ? kEnrolInSimulation : kEnrol))) {
    return Ending{kFailed, processes_.reason()};
  }
  if (auto ending = interruption(signals_)) {
    return *std::move(ending);
  }
  return {};
}

// In a simulation: handles deaths and restarts when they happen, whatever the steps. Returns the time of the next
// restart.
rt::MonoTime Running::attend_processes() {
  const rt::MonoTime now = rt::MonoClock::now();
  if (processes_.supervise(now, kernel_.now()) || !await_processes(now + kEnrolInSimulation)) {
    engine_.request_stop();
  }
  return processes_.next_restart().value_or(scheduler::SimulatedKernel::kNever);
}

// Waits until all of them are ready, or until `until`. Returns false if one of them ends the run.
bool Running::await_processes(rt::MonoTime until) {
  while (!processes_.ready() && rt::MonoClock::now() < until && signals_.wait(kEndCheck / 10) == 0) {
    if (processes_.supervise(rt::MonoClock::now(), kernel_.now())) {
      return false;
    }
    console_.report(kernel_.now(), false);
  }
  return true;
}

Result<void, Ending> Running::start_schedule() {
  if (checked_.mirror) {
    checked_.mirror->routes = checked_.routes.name_writers({checked_.config, checked_.check, engine_});
  }
  checked_.check = {};  // no longer needed; what is left stays in memory
  prepared_.store->prefault();
  prepared_.run_file.prefault();
  if (!simulation_) {
    if (auto locked = lock_memory(options_, prepared_.rights, run_, console_); !locked) {
      return locked;
    }
  }
  for (const scheduler::Task& task : loaded_.tasks) {
    if (task.type == ModuleType::Thread) {
      run_.modules()[task.index].state.store(ModuleState::Running);
    }
  }
  if (prepared_.retainer) {
    prepared_.retainer->start(run_, console_);
  }
  if (auto mirrored = mirror_.start(simulation_ ? &*simulation_ : nullptr); !mirrored) {
    return mirrored;
  }
  const config::Config& config = checked_.config;
  if (!simulation_) {
    checked_.external.start(options_.node, *prepared_.store, mirror_.block(),
                            cores_without_modules(config, prepared_.rights), console_);
  }
  if (simulation_) {
    simulation_->watch_end([this] { return engine_.finished(); });
    simulation_->attend_by([this] { return attend_processes(); });
    hang_watch_.emplace([this] { return simulation_->kernel().resumptions(); },
                        [this] { engine_.end_runs_in_progress(); });
  }
  if (recording_ && !simulation_) {
    recording_->start(cores_without_modules(config, prepared_.rights));
  }
  if (!simulation_ && prepared_.tape) {
    kernel_watch_.emplace(options_.node, prepared_.rights.realtime(), cores_without_modules(config, prepared_.rights));
  }
  if (const Status started = engine_.start(ticks()); !started) {
    console_.error("cannot start the schedule: {}", describe(started.error()));
    return Ending{kFailed};
  }
  const scheduler::RunBlockSetup& setup = prepared_.setup;
  mirror_.announce();
  normal_threads_.start();
  run_.state.store(scheduler::NodeState::Running);
  console_.info("running {} modules of {}: basic period {}, macro period {}{}", config.modules.size(),
                config.file.filename().string(), base::format_duration(base::Nanos(setup.basic_period_ns)),
                base::format_duration(base::Nanos(setup.macro_period_ns)),
                simulation_ ? ", in virtual time"
                : prepared_.rights.realtime()
                    ? fmt::format(", FIFO {} on core {}", scheduler::kTickPriority, prepared_.rights.core)
                    : "");
  return {};
}

// 0: unlimited.
std::uint64_t Running::ticks() const noexcept {
  if (!options_.duration) {
    return 0;
  }
  const std::int64_t basic = prepared_.setup.basic_period_ns;
  return static_cast<std::uint64_t>(std::max<std::int64_t>(1, (options_.duration->count() + basic - 1) / basic));
}

// Waits until the next check is due. Returns a stop signal, 0 if none was received.
int Running::pass() {
  return simulation_ ? simulation_->pass(kEndCheck) : signals_.wait(kEndCheck);
}

Ending Running::supervise() {
  Ending ending;
  while (!engine_.finished()) {
    const int number = pass();
    if (keyframes_) {
      keyframes_->take(kernel_, commands_.exchanges());
    }
    if (recording_ && simulation_) {
      recording_->take(kernel_.now());
    }
    const rt::MonoTime now = rt::MonoClock::now();
    prepared_.store->beat(now);
    prepared_.pools.sweep(now);
    if (number != 0) {
      ending = {number == SIGINT ? kInterrupted : kOk, fmt::format("signal {} ({})", number, ::strsignal(number))};
      break;
    }
    if (simulation_ && simulation_->left()) {
      ending = {kOk, simulation_->place() != nullptr ? "end of the simulation" : "end of the steps"};
      break;
    }
    if (processes_.supervise(now, kernel_.now(), reported_.stalled_ns.load(std::memory_order_relaxed)) ||
        (simulation_ && !await_processes(now + kEnrolInSimulation))) {
      ending = {kFailed, processes_.reason()};
      break;
    }
    if (std::string why = memory_.check(now); !why.empty()) {
      ending = {kFailed, std::move(why)};
      break;
    }
    commands_.poll(now);
    mirror_.announce();
    forces_.report_changes(*prepared_.store, console_);
    if (black_box_) {
      black_box_->check(now);
    }
    console_.report(kernel_.now(), false);
  }
  if (std::string why = memory_.check(rt::MonoClock::now()); !why.empty()) {  // may have ended the schedule
    ending = {kFailed, std::move(why)};
  }
  if (const std::uint32_t order = reported_.stop_order.load(std::memory_order_acquire); order != 0) {
    const scheduler::ModuleRecord& module = run_.modules()[order - 1];
    ending.code = kFailed;
    if (ending.reason.empty()) {
      ending.reason =
          fmt::format("module {}: {}", module.name,
                      module.faults.load() > 0 ? "faulted (policy stop-node)" : "overrun (policy stop-node)");
    }
  }
  return ending;
}

// Memory was lost: writes the fail-safe values to what remains, and keeps the tape for the black box.
void Running::secure() {
  for (std::uint32_t i = 0; i < checked_.config.modules.size(); ++i) {
    prepared_.failsafe->apply(i);
  }
  if (black_box_) {
    black_box_->keep_at_end(memory_.check(rt::MonoClock::now()));
  }
}

bool Running::stop(const std::string& why) {
  run_.state.store(scheduler::NodeState::Stopping);
  engine_.request_stop();
  engine_.join();
  if (memory_.lost()) {
    secure();
  }
  if (black_box_) {
    black_box_->end();
  }
  kernel_watch_.reset();
  const bool recorded = !recording_ || recording_->end(facts_text(options_, prepared_, mirror_.block(), why));
  hang_watch_.reset();
  normal_threads_.stop();
  processes_.end_all();
  runtime::stop_function_servers();
  commands_.end();
  if (started_) {
    (void)phases_.call_all("stop", &ModuleDescriptor::stop);
  }
  checked_.external.stop();
  mirror_.stop();  // values written by stop() are still sent
  return recorded;
}

}  // namespace indurop::node
