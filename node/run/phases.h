// SPDX-License-Identifier: Apache-2.0
// start() and stop() of the thread modules: not real-time, guarded like run(); a stop signal is accepted meanwhile.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "config/model/config.h"
#include "core/base/stop_signal.h"
#include "node/modules/module_library.h"
#include "node/run/console.h"
#include "scheduler/runner.h"

namespace indurop::node {

class Phases {
 public:
  Phases(const config::Config& config, scheduler::RunBlock& run, const std::vector<ModuleLibrary>& libraries,
         Console& console, base::StopSignal& signals, const scheduler::Hooks& hooks, scheduler::Kernel& kernel);

  // Calls one function of every thread module that has it, by priority. Returns false if any of them failed: those
  // modules are marked as faulted, with the reason. Modules stopped by command have had their stop() called and are
  // left out.
  bool call_all(const char* phase, void (*ModuleDescriptor::*function)());

  // One call on a thread of its own, for a caller that must not wait.
  struct Call;
  using CallPointer = std::unique_ptr<Call, void (*)(Call*)>;
  // Returns null after an error, reported on the console.
  CallPointer begin(std::uint32_t index, const char* phase, void (*function)());
  // Returns true if the call has returned. A call that takes longer than `limit` (0: none) is ended as a fault.
  bool ended(Call& call, rt::MonoTime now, std::chrono::nanoseconds limit);
  // Called after that: returns false if the call failed; the module is then marked as faulted, with the reason.
  bool conclude(CallPointer call);
  // The same for a version that does not run: returns the reason; nullopt: the call succeeded.
  static std::optional<std::string> failure_of(CallPointer call);
  static constexpr std::chrono::seconds kGrace{3};  // for stop()

 private:
  bool call(std::uint32_t index, const char* phase, void (*function)());

  const config::Config& config_;
  scheduler::RunBlock& run_;
  const std::vector<ModuleLibrary>& libraries_;
  Console& console_;
  base::StopSignal& signals_;
  scheduler::Hooks hooks_;
  scheduler::Kernel& kernel_;
};

}  // namespace indurop::node
