// SPDX-License-Identifier: Apache-2.0
// Repeats single runs of a recording: starts the modules, gives each run the inputs and times it had, and restarts
// modules that were restarted.

#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "node/modules/hang_watch.h"
#include "node/modules/processes.h"
#include "node/replay/replayed_modules.h"
#include "node/replay/replayed_process.h"
#include "node/run/phases.h"
#include "scheduler/runner.h"
#include "store/tape/replay_input.h"

namespace indurop::node {

class Repeater {
 public:
  // All references are borrowed.
  Repeater(const Options& options, Console& console, base::StopSignal& signals, const Checked& checked,
           const Prepared& prepared, const Loaded& loaded);

  // Creates the memory in which process modules get their inputs. Returns false after an error.
  bool prepare_processes();
  // The calling thread repeats the runs.
  void attach();
  // Starts the modules. Returns false after an error.
  bool start(const ReplayedModules& modules);
  // Repeats the run whose inputs the module has. Returns false, after an error, if the replay cannot continue.
  bool repeat(ReplayedModule& module, const recorder::RunWords& run);
  // What the module keeps now; null: that cannot be taken. Valid until the next call.
  const ModuleMemory* memory_of(const ReplayedModule& module);
  // For a version of the module that does not run: calls its start() or stop(), which change nothing in the store.
  // start_apart() returns false after an error.
  bool start_apart(const ReplayedModule& module, const ModuleLibrary& version);
  void stop_apart(const ReplayedModule& module, const ModuleLibrary& version);
  // Calls stop() of a module that is to be started again as another version.
  void stop_for_exchange(ReplayedModule& module);
  // For a process module. Its next process is one of this file.
  void set_program(const ReplayedModule& module, const std::filesystem::path& file);
  // Ends its process and starts another one. Returns false after an error.
  bool restart(ReplayedModule& module);
  // What its process keeps now; nothing: that cannot be taken. And puts back what fits of that of another one.
  std::optional<ReplayedProcess::State> state_of(const ReplayedModule& module);
  void put_back(const ReplayedModule& module, const ReplayedProcess::State& state);
  // Lets a module run again whose version was ended by a fault.
  void resume(ReplayedModule& module);
  // Ends the modules.
  void stop();

 private:
  // A clock that is stopped except when a run of the recording sets it.
  class Kernel final : public scheduler::Kernel {
   public:
    explicit Kernel(std::vector<std::atomic<std::int64_t>*> shown) : shown_(std::move(shown)) {}
    rt::MonoTime now() noexcept override { return rt::mono_time(shown_.front()->load(std::memory_order_relaxed)); }
    void sleep_until(rt::MonoTime /*deadline*/) noexcept override {}
    void set(std::int64_t ns) noexcept;

   private:
    std::vector<std::atomic<std::int64_t>*> shown_;
  };

  scheduler::Hooks hooks();
  scheduler::Hooks run_hooks();
  void restore(const ReplayedModule& module);
  void find_kept(ReplayedModule& module);
  bool restart_process(std::uint32_t index);
  bool call(std::uint32_t index, const char* phase, void (*function)());
  std::optional<std::string> call_apart(const ReplayedModule& module, const ModuleLibrary& version, const char* phase,
                                        void (*function)());
  void run_process(ReplayedModule& module, const tape::RunTail& tail);

  const Options& options_;
  Console& console_;
  base::StopSignal& signals_;
  vars::Store& store_;
  const std::vector<ModuleLibrary>& libraries_;
  scheduler::RunBlock& run_;
  Kernel kernel_;
  scheduler::CoreTrace trace_;
  scheduler::Runner runner_;
  Phases phases_;
  Processes processes_;
  std::map<std::uint32_t, ReplayedProcess> kept_;        // of process modules, by index
  std::optional<tape::ReplayInputWriter> replay_input_;  // for process modules, if there are any
  std::atomic<std::uint64_t> returned_{0};               // runs, for the check whether one hangs
  std::optional<HangWatch> hang_watch_;
};

}  // namespace indurop::node
