// SPDX-License-Identifier: Apache-2.0
// Outputs that jobs switch on for a time: they switch off even if the job has ended. Real-time safe.

#pragma once

#include <indurop/robot/controller.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace indurop::robot {

class Pulses {
 public:
  // Switches on for `seconds` from now; the time starts again if it is on already. Returns false if 16 other outputs
  // are on.
  bool start(std::size_t signal, double seconds, Signals& signals) noexcept {
    auto* place =
        std::find_if(all_.begin(), all_.end(), [&](const Pulse& one) { return one.on && one.signal == signal; });
    if (place == all_.end()) {
      place = std::find_if(all_.begin(), all_.end(), [](const Pulse& one) { return !one.on; });
    }
    if (place == all_.end()) {
      return false;
    }
    *place = {true, signal, seconds};
    signals.write(signal, 1);
    return true;
  }
  // Called once per period, before jobs run.
  void step(double seconds, Signals& signals) noexcept {
    for (Pulse& one : all_) {
      one.left -= seconds;
      if (one.on && one.left < seconds / 2) {
        one.on = false;
        signals.write(one.signal, 0);
      }
    }
  }
  [[nodiscard]] bool any() const noexcept {
    return std::any_of(all_.begin(), all_.end(), [](const Pulse& one) { return one.on; });
  }
  // Called when the output is set in another way: its pulse no longer switches it off.
  void forget(std::size_t signal) noexcept {
    for (Pulse& one : all_) {
      one.on = one.on && one.signal != signal;
    }
  }

 private:
  struct Pulse {
    bool on = false;
    std::size_t signal = 0;
    double left = 0;  // s
  };
  std::array<Pulse, 16> all_{};
};

}  // namespace indurop::robot
