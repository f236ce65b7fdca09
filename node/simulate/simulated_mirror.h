// SPDX-License-Identifier: Apache-2.0
// The mirror of a board in a simulated plant: the same exchange as in a network, driven by threads of the simulated
// kernel; its messages go to and come from the conductor.

#pragma once

#include <indurop/result.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/rt/signal_word.h"
#include "network/mirror/frames/exchange.h"
#include "network/mirror/frames/schedule.h"
#include "network/mirror/simulated/simulated_plane.h"
#include "node/simulate/board_channel.h"
#include "node/simulate/running_mirror.h"
#include "scheduler/simulated_kernel.h"
#include "store/vars/store.h"

namespace indurop::node {

class SimulatedMirror final : public RunningMirror {
 public:
  // All references are borrowed. Errors: as of mirror::Exchange::make() and of the kernel's threads.
  static Result<std::unique_ptr<SimulatedMirror>> start(mirror::Settings settings, const std::string& node,
                                                        const BoardPlace& place, vars::Store& store,
                                                        const std::atomic<std::uint64_t>& tick,
                                                        scheduler::SimulatedKernel& kernel);
  SimulatedMirror(const BoardPlace& place, const vars::Store& store, scheduler::SimulatedKernel& kernel,
                  std::unique_ptr<mirror::Exchange> exchange);
  ~SimulatedMirror() override;

  void notify() noexcept override { wake_sender_.wake(); }
  // One clock for all boards.
  void announce(rt::MonoTime epoch, std::chrono::nanoseconds basic, std::chrono::nanoseconds macro) noexcept override {
    schedule_ = {rt::wall_time(rt::to_ns(epoch)), basic, macro};
  }
  [[nodiscard]] const mirror::MirrorBlock& block() const noexcept override { return exchange_->block(); }

  void arrived(const mirror::Message& message);
  std::vector<mirror::Message> take_sent() { return plane_.take_sent(); }

 private:
  Status start_threads();
  Status start_thread(const char* name, rt::SignalWord& wake, std::function<std::int64_t(std::int64_t)> step);

  scheduler::SimulatedKernel& kernel_;
  mirror::SimulatedPlane plane_;
  std::unique_ptr<mirror::Exchange> exchange_;
  mirror::Schedule schedule_;
  bool stop_ = false;
  rt::SignalWord wake_manager_{};
  rt::SignalWord wake_sender_{};
  rt::SignalWord wake_bulk_{};
  std::vector<std::unique_ptr<scheduler::KernelThread>> threads_;
};

}  // namespace indurop::node
