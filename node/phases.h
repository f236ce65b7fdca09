// SPDX-License-Identifier: Apache-2.0
// start() and stop() of the thread modules: not real-time, guarded like run(), and a stop signal is heard meanwhile.

#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "deploy/config.h"
#include "node/console.h"
#include "node/module_library.h"
#include "node/stop_signal.h"
#include "scheduler/runner.h"

namespace indurop::node {

class Phases {
 public:
  Phases(const deploy::Config& config, scheduler::RunBlock& run, const std::vector<ModuleLibrary>& libraries,
         Console& console, StopSignal& signals, const scheduler::Hooks& hooks);

  // Calls one function of every thread module that has it, by priority. False if any of them failed: those modules are
  // marked as faulted, with the reason.
  bool call_all(const char* phase, void (*ModuleDescriptor::*function)());

 private:
  bool call(std::uint32_t index, const char* phase, void (*function)());
  void wait_for_end(std::uint32_t index, const char* phase, scheduler::Runner& runner, const std::atomic<bool>& done);

  const deploy::Config& config_;
  scheduler::RunBlock& run_;
  const std::vector<ModuleLibrary>& libraries_;
  Console& console_;
  StopSignal& signals_;
  scheduler::Hooks hooks_;
  scheduler::SystemClock clock_;
};

}  // namespace indurop::node
