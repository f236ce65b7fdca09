// SPDX-License-Identifier: Apache-2.0
// Last phase of a run: modules, processes, mirrors and the schedule are started and supervised, and ended in reverse
// order. A stop request is accepted at any time.

#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "node/modules/hang_watch.h"
#include "node/modules/module_commands.h"
#include "node/modules/normal_threads.h"
#include "node/modules/processes.h"
#include "node/parts/black_box.h"
#include "node/parts/board_mirror.h"
#include "node/parts/force_watch.h"
#include "node/parts/kernel_watch.h"
#include "node/parts/keyframe_part.h"
#include "node/parts/memory_watch.h"
#include "node/parts/record_part.h"
#include "node/run/loaded.h"
#include "node/run/phases.h"
#include "node/simulate/simulation.h"
#include "scheduler/engine.h"

namespace indurop::node {

class Running {
 public:
  // All references are borrowed.
  Running(const Options& options, Console& console, base::StopSignal& signals, Checked& checked, Prepared& prepared,
          Loaded& loaded);
  ~Running() = default;
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  Result<void, Ending> start();
  // Returns when the duration is over or something ends the run.
  Ending supervise();
  // Ends what was started, in reverse. Called once, whatever start() returned. Returns false if a recording is
  // incomplete, which is reported.
  bool stop(const std::string& why);

 private:
  Result<void, Ending> start_modules();
  Result<void, Ending> launch_processes();
  Result<void, Ending> start_schedule();
  [[nodiscard]] std::uint64_t ticks() const noexcept;
  scheduler::Kernel& make_kernel();
  rt::MonoTime attend_processes();
  bool await_processes(rt::MonoTime until);
  void secure();
  int pass();
  scheduler::Hooks hooks();
  void change_batch(std::uint64_t tick) noexcept;  // values requested to change in one tick
  scheduler::Hooks plain_hooks();
  scheduler::Hooks apart_hooks();
  static void set_tape(scheduler::Hooks& hooks, const tape::Tape& tape);
  [[nodiscard]] scheduler::EngineSettings engine_settings();

  const Options& options_;
  Console& console_;
  base::StopSignal& signals_;
  Checked& checked_;
  Prepared& prepared_;
  scheduler::RunBlock& run_;
  Loaded& loaded_;
  bool started_ = false;  // start() of the modules was called, so stop() will be
  // What the engine reports.
  struct {
    std::atomic<std::uint32_t> stop_order{0};  // 1 + index of the module whose policy stops the node
    std::atomic<std::int64_t> stalled_ns{0};   // as EngineSettings::stalled_ns
  } reported_;
  scheduler::SystemKernel system_;
  std::optional<Simulation> simulation_;  // in virtual time
  scheduler::Kernel& kernel_;             // the one of the two that the schedule runs on
  ForceWatch forces_;
  BoardMirror mirror_;
  scheduler::Engine engine_;
  MemoryWatch memory_;
  std::optional<HangWatch> hang_watch_;  // in a simulation
  Phases phases_;
  NormalThreads normal_threads_;
  Processes processes_;
  ModuleCommands commands_;
  std::optional<KernelWatch> kernel_watch_;  // none in a simulation, like the black box
  std::optional<BlackBox> black_box_;
  std::unique_ptr<KeyframePart> keyframes_;  // null if no module declares what it keeps
  std::unique_ptr<RecordPart> recording_;    // null if not requested
};

}  // namespace indurop::node
