// SPDX-License-Identifier: Apache-2.0
#include "node/run/node.h"

#include "core/base/standard_files.h"
#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "core/rt/guard.h"
#include "node/replay/replay.h"
#include "node/run/report.h"
#include "node/run/running.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::ModuleState;

bool replays(const Options& options) {
  return !options.replay.file.empty();
}

Ending run_modules(const Options& options, Console& console, base::StopSignal& signals, Checked& checked,
                   Prepared& prepared) {
  checked.config.modules.reserve(checked.config.modules.size() + scheduler::kSpareModules);
  auto loaded = load(options, checked, prepared, console, signals);
  if (!loaded) {
    return std::move(loaded).error();
  }
  if (replays(options)) {
    return Replay(options, console, signals, checked, prepared, *loaded).run();
  }
  Running running(options, console, signals, checked, prepared, *loaded);
  const auto started = running.start();
  Ending ending = started ? running.supervise() : started.error();
  if (!running.stop(ending.reason.empty() ? "end of the duration" : ending.reason) && ending.code == kOk) {
    ending.code = kFailed;
  }
  return ending;
}

// Returns false if retained values are not on the disk.
bool save_values(Prepared& prepared, Console& console) {
  scheduler::RunBlock& run = prepared.run();
  run.state.store(scheduler::NodeState::Stopping);
  const bool saved = !prepared.retainer || prepared.retainer->stop(console);
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    auto& state = run.modules()[i].state;
    if (const ModuleState now = state.load(); now != ModuleState::Faulted && now != ModuleState::Exited) {
      state.store(ModuleState::Stopped);
    }
  }
  return saved;
}

// Reports the measurements, on the console and as a file. Returns false if the file could not be written.
bool print_statistics(const Options& options, const scheduler::RunBlock& run, const Console& console) {
  bool ok = true;
  if (!options.report.empty()) {
    if (const auto written = write_report(run, options.report); !written) {
      console.error("{}", written.error().text);
      ok = false;
    }
  }
  if (!options.quiet) {
    (void)base::print_within(base::kPatienceAtEnd, summary_table(run));
  }
  return ok;
}

// Reports how the run ended and writes it into the run block; returns the exit code.
int conclude(const Options& options, Console& console, scheduler::RunBlock& run, Ending ending) {
  if (replays(options)) {
    run.state.store(ending.code == kOk ? scheduler::NodeState::Stopped : scheduler::NodeState::Failed);
    return ending.code;  // the replay has reported; its times are those of the recording
  }
  console.report(rt::MonoClock::now(), true);
  if (run.tick.load() == 0 && !ending.reason.empty() && ending.code == kFailed) {
    console.error("stopped before the first tick: {}", ending.reason);
  }
  if (ending.reason.empty()) {
    ending.reason = ending.code == kOk ? "end of the duration" : "could not start";
  }
  rt::copy_text(run.stop_reason, ending.reason);
  if (run.tick.load() > 0) {
    if (!print_statistics(options, run, console) && ending.code == kOk) {
      ending.code = kFailed;
    }
    console.info("stopped: {}; {} ticks, {} lost", ending.reason, run.tick.load(), run.lost_ticks.load());
  }
  std::uint32_t faulted = 0;
  for (std::uint32_t i = 0; i < run.module_count; ++i) {
    faulted += run.modules()[i].state.load() == ModuleState::Faulted ? 1U : 0U;
  }
  if (faulted > 0 && ending.code == kOk) {
    console.error("{} module{} faulted during the run", faulted, faulted == 1 ? "" : "s");
    ending.code = kFailed;
  }
  run.state.store(ending.code == kOk || ending.code == kInterrupted ? scheduler::NodeState::Stopped
                                                                    : scheduler::NodeState::Failed);
  return ending.code;
}

}  // namespace

int run_node(const Options& options) {
  const bool journal = options.journal || base::stderr_is_journal();
  Console console(options.node, options.quiet, journal ? std::make_shared<const base::Journal>() : nullptr);
  base::StopSignal signals;
  rt::install_guard_handlers();
  rt::catch_faults_also_by(&runtime::catch_fault);
  auto checked = check(options, console);
  if (!checked) {
    // In a replay that code means that values differ.
    const bool replays = !options.replay.file.empty() && checked.error().code == kCheckFailed;
    return replays ? kFailed : checked.error().code;
  }
  auto prepared = prepare(options, *checked, console, signals);
  if (!prepared) {
    return prepared.error().code;
  }
  Ending ending = run_modules(options, console, signals, *checked, *prepared);
  if (!save_values(*prepared, console) && (ending.code == kOk || ending.code == kInterrupted)) {
    ending.code = kFailed;
  }
  return conclude(options, console, prepared->run(), std::move(ending));
}

}  // namespace indurop::node
