// SPDX-License-Identifier: Apache-2.0
// A run in virtual time: the schedule's kernel, and how fast its time passes.

#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "base/stop_signal.h"
#include "config/run_options.h"
#include "scheduler/simulated_kernel.h"
#include "vars/store.h"

namespace indurop::node {

class Simulation {
 public:
  // Shows its time in the store and in the run block, both borrowed.
  Simulation(const config::Simulation& settings, vars::Store& store, scheduler::RunBlock& run,
             base::StopSignal& signals, scheduler::ProcessWatch watch);

  scheduler::SimulatedKernel& kernel() noexcept { return kernel_; }

  // Lets `look` of virtual time pass, in --step mode what standard input asks for. Returns a stop signal, 0 if none has
  // come.
  int pass(std::chrono::nanoseconds look);
  // Standard input of --step has ended, or asked for it.
  [[nodiscard]] bool left() const noexcept { return left_; }

 private:
  int keep_pace();
  int step();
  bool obey(const std::string& line);
  void tell_place();

  const config::Simulation& settings_;
  scheduler::RunBlock& run_;
  base::StopSignal& signals_;
  scheduler::SimulatedKernel kernel_;
  rt::MonoTime began_;  // in real time, when virtual time began to pass
  std::string input_;
  rt::MonoTime stands_at_{};
  bool left_ = false;
};

}  // namespace indurop::node
