// SPDX-License-Identifier: Apache-2.0
// Executes commands about single modules while the node runs: a module is taken out of the schedule and put back, its
// start() and stop() are called in the background, the others are not affected. Called by the thread that supervises
// the node.

#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "node/exchange/exchanges.h"
#include "node/exchange/schedule_change.h"
#include "node/modules/failsafe.h"
#include "node/modules/normal_threads.h"
#include "node/modules/processes.h"
#include "node/run/phases.h"
#include "scheduler/engine.h"
#include "scheduler/module_command.h"
#include "store/tape/tape.h"

namespace indurop::node {

class ModuleCommands {
 public:
  // The parts of the node needed to execute commands.
  struct Parts {
    const Options& options;
    config::Config& config;
    scheduler::RunBlock& run;
    std::vector<ModuleLibrary>& libraries;
    scheduler::Engine& engine;
    Processes& processes;
    NormalThreads& normal_threads;
    Phases& phases;
    FailSafe& failsafe;
    Console& console;
    tape::Tape* tape;  // null: none
    Placement placement;
    BoardRoutes& routes;
    BoardMirror& mirror;
  };
  // `check`: as the node starts. `apart`: for versions that do not run.
  ModuleCommands(const Parts& parts, const Exchanges::Parts& exchanges, const config::CheckResult& check, Phases apart)
      : parts_(parts),
        exchanges_(exchanges, check, apart),
        schedule_(ScheduleChange::Parts{parts.options, parts.config, parts.run, parts.libraries, parts.engine,
                                        exchanges.store, parts.console, parts.placement, parts.routes, parts.mirror},
                  Arrivals::Parts{parts.config, parts.run, parts.libraries, parts.engine, exchanges.store,
                                  parts.failsafe, exchanges_, parts.phases, parts.processes, parts.normal_threads,
                                  parts.console, parts.tape}) {
    exchanges_.connect(schedule_);
  }

  // Accepts new commands and continues those in progress.
  void poll(rt::MonoTime now);
  // Called when the schedule has ended: waits for calls in progress and answers the remaining commands.
  void end();
  [[nodiscard]] const Exchanges& exchanges() const noexcept { return exchanges_; }

 private:
  // Progress of a command.
  enum class Step { Leaving, Stopping, Starting, Launching };
  struct Work {
    std::uint32_t module;
    scheduler::ModuleCommand command;
    Step step;
    rt::MonoTime began;
    Phases::CallPointer call;
    std::optional<ScheduleChange::Leaver> leaver;  // it is stopped because of the schedule
  };
  void poll_schedule(rt::MonoTime now);
  void take(std::uint32_t module, scheduler::ModuleCommand command, rt::MonoTime now,
            const std::optional<ScheduleChange::Leaver>& leaver = {});
  // Returns true when the command is finished.
  bool go_on(Work& work, rt::MonoTime now);
  void leave(const Work& work, rt::MonoTime now);
  bool has_left(const Work& work, rt::MonoTime now);
  bool call_stop(Work& work, rt::MonoTime now);
  bool rest(Work& work, rt::MonoTime now);
  bool begin_start(Work& work, rt::MonoTime now);
  bool enter(Work& work);
  bool launched(Work& work, rt::MonoTime now);
  [[nodiscard]] bool writes(std::uint32_t module, std::uint64_t variable) const;
  [[nodiscard]] scheduler::CommandResult started(std::uint32_t module) const;
  bool answer(const Work& work, scheduler::CommandResult result);
  [[nodiscard]] bool is_process(std::uint32_t module) const noexcept;
  [[nodiscard]] scheduler::ModuleRecord& record(std::uint32_t module) const noexcept {
    return parts_.run.modules()[module];
  }

  Parts parts_;
  std::vector<Work> works_;
  Exchanges exchanges_;
  ScheduleChange schedule_;
};

}  // namespace indurop::node
