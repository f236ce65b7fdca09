// SPDX-License-Identifier: Apache-2.0
// A mirror that runs: in the network, or in a simulated plant.

#pragma once

#include <chrono>

#include "core/rt/clock.h"
#include "network/mirror/frames/mirror_block.h"
#include "network/mirror/frames/settings.h"

namespace indurop::node {

class RunningMirror {
 public:
  RunningMirror() = default;
  RunningMirror(const RunningMirror&) = delete;
  RunningMirror& operator=(const RunningMirror&) = delete;
  // Stops the mirror; the other boards notice at once that this one is gone.
  virtual ~RunningMirror() = default;

  // Announces when the schedule began, and its periods.
  virtual void announce(rt::MonoTime epoch, std::chrono::nanoseconds basic,
                        std::chrono::nanoseconds macro) noexcept = 0;
  // Called when the store may have changed. Real-time safe.
  virtual void notify() noexcept = 0;
  // The board exchanges this from now on. Only deployments change it, and a simulation has none.
  virtual void follow(const mirror::Routes& /*routes*/) {}
  [[nodiscard]] virtual const mirror::MirrorBlock& block() const noexcept = 0;
};

}  // namespace indurop::node
