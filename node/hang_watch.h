// SPDX-License-Identifier: Apache-2.0
// In a simulation nobody's time passes while a module does not return. This looks in real time: what has not returned
// for long, or not since somebody wants the node to end, is ended as a fault.

#pragma once

#include <atomic>

#include "rt/thread.h"
#include "scheduler/engine.h"
#include "scheduler/simulated_kernel.h"

namespace indurop::node {

class HangWatch {
 public:
  HangWatch(const scheduler::SimulatedKernel& kernel, scheduler::Engine& engine);
  ~HangWatch();
  HangWatch(const HangWatch&) = delete;
  HangWatch& operator=(const HangWatch&) = delete;
  static constexpr std::chrono::seconds kPatience{10};

 private:
  void loop();

  const scheduler::SimulatedKernel& kernel_;
  scheduler::Engine& engine_;
  std::atomic<bool> stop_{false};
  rt::Thread thread_;
};

}  // namespace indurop::node
