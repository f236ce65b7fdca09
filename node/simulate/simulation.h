// SPDX-License-Identifier: Apache-2.0
// A run in virtual time: the schedule's kernel, and how fast its time passes.

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "config/run_options.h"
#include "core/base/stop_signal.h"
#include "network/mirror/simulated/message.h"
#include "node/simulate/board_channel.h"
#include "node/simulate/step_input.h"
#include "scheduler/simulated_kernel.h"
#include "store/vars/store.h"

namespace indurop::node {

class Simulation {
 public:
  // Every run begins at the same time, and none at 0, which means real time.
  static constexpr rt::MonoTime kBegin = rt::mono_time(rt::kNanosPerSecond);

  // Writes its time into the store and the run block, both borrowed.
  Simulation(const config::Simulation& settings, vars::Store& store, scheduler::RunBlock& run,
             base::StopSignal& signals, scheduler::ProcessWatch watch);

  scheduler::SimulatedKernel& kernel() noexcept { return kernel_; }

  // The place of this board in a simulated plant; null: there is no such plant.
  [[nodiscard]] const BoardPlace* place() const noexcept { return conductor_ ? &place_ : nullptr; }
  // Connects the messages between this board and others; watch_end() sets the check whether the board has ended.
  struct Link {
    std::function<void(const mirror::Message&)> arrived;
    std::function<std::vector<mirror::Message>()> take_sent;
  };
  void connect(Link link) { link_ = std::move(link); }
  void watch_end(std::function<bool()> ended) { ended_ = std::move(ended); }
  // Sets the callback that serves processes. Called when something from outside may have happened, before time
  // advances, and at the time it returned last.
  void attend_by(std::function<rt::MonoTime()> attend) { attend_ = std::move(attend); }

  // Lets `duration` of virtual time pass, in --step mode as much as standard input requests. Returns a stop signal, 0
  // if none was received.
  int pass(std::chrono::nanoseconds duration);
  // Returns true if standard input of --step has ended or requested the end, or the plant's simulation is over.
  [[nodiscard]] bool left() const noexcept { return left_; }

 private:
  int follow(std::chrono::nanoseconds duration);
  bool answer();
  int keep_pace();
  int step();
  void go_to(rt::MonoTime until);

  const config::Simulation& settings_;
  scheduler::RunBlock& run_;
  base::StopSignal& signals_;
  std::optional<BoardChannel> conductor_;  // of a plant
  BoardPlace place_;
  scheduler::SimulatedKernel kernel_;
  rt::MonoTime began_;  // in real time, when virtual time began to pass
  StepInput input_;
  std::optional<rt::MonoTime> stands_at_;
  bool left_ = false;
  Link link_;
  std::function<bool()> ended_;
  std::function<rt::MonoTime()> attend_ = [] { return scheduler::SimulatedKernel::kNever; };
  bool ready_reported_ = false;
  std::int64_t busy_ns_ = 0;  // processor time of this thread at the last answer
};

}  // namespace indurop::node
