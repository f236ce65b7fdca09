// SPDX-License-Identifier: Apache-2.0
// Carries out commands about single modules while the node runs: a module is taken out of the schedule and put back,
// its start() and stop() are called beside it, the others do not notice. Called by the thread that supervises the node.

#pragma once

#include <cstdint>
#include <vector>

#include "node/failsafe.h"
#include "node/normal_threads.h"
#include "node/phases.h"
#include "node/processes.h"
#include "scheduler/engine.h"
#include "scheduler/module_command.h"
#include "tape/tape.h"

namespace indurop::node {

class ModuleCommands {
 public:
  // What the commands are carried out with.
  struct Parts {
    const config::Config& config;
    scheduler::RunBlock& run;
    const std::vector<ModuleLibrary>& libraries;
    scheduler::Engine& engine;
    Processes& processes;
    NormalThreads& normal_threads;
    Phases& phases;
    FailSafe& failsafe;
    Console& console;
    tape::Tape* tape;  // null: none
  };
  explicit ModuleCommands(const Parts& parts) : parts_(parts) {}

  // Takes new commands and goes on with those under way.
  void look(rt::MonoTime now);
  // The node ends, its schedule has: waits for calls in progress and answers what is left.
  void end();

 private:
  // Where a command is.
  enum class Step { Leaving, Stopping, Starting, Launching };
  struct Work {
    std::uint32_t module;
    scheduler::ModuleCommand command;
    Step step;
    rt::MonoTime began;
    Phases::CallPointer call;
  };
  void take(std::uint32_t module, scheduler::ModuleCommand command, rt::MonoTime now);
  // True when there is nothing left to do for it.
  bool go_on(Work& work, rt::MonoTime now);
  void leave(const Work& work, rt::MonoTime now);
  bool has_left(const Work& work, rt::MonoTime now);
  bool call_stop(Work& work, rt::MonoTime now);
  bool rest(Work& work, rt::MonoTime now);
  bool begin_start(Work& work, rt::MonoTime now);
  bool enter(Work& work);
  bool launched(Work& work, rt::MonoTime now);
  [[nodiscard]] scheduler::CommandResult started(std::uint32_t module) const;
  bool answer(const Work& work, scheduler::CommandResult result);
  [[nodiscard]] bool is_process(std::uint32_t module) const noexcept;
  [[nodiscard]] scheduler::ModuleRecord& record(std::uint32_t module) const noexcept {
    return parts_.run.modules()[module];
  }

  Parts parts_;
  std::vector<Work> works_;
};

}  // namespace indurop::node
