// SPDX-License-Identifier: Apache-2.0
// An enabling device that is operated remotely: it counts as pressed only while its beat continues.

#pragma once

#include <cstdint>
#include <optional>

namespace indurop::robot {

class EnablingSwitch {
 public:
  // Time it counts as pressed after the last beat.
  static constexpr double kPatience = 0.3;  // s

  // Called once per period of `period` seconds. Returns whether the switch is held. `beat` 0: the switch is local and
  // its contact alone counts. Otherwise `beat` has to change within kPatience; once it has not, the switch has to be
  // released before it counts again. The same applies to any switch that is already pressed at the first call, so that
  // nothing moves because the robot task starts. Real-time safe.
  bool holds(bool pressed, std::uint32_t beat, double period) noexcept {
    const bool first = !last_;
    since_ = first || beat != *last_ ? 0 : since_ + period;
    last_ = beat;
    lapsed_ = pressed && (lapsed_ || first || (beat != 0 && since_ > kPatience + period / 2));
    return pressed && !lapsed_;
  }
  // A switch that is pressed has to be released before it counts again. Real-time safe.
  void lapse() noexcept { lapsed_ = true; }

 private:
  std::optional<std::uint32_t> last_;
  double since_ = 0;
  bool lapsed_ = false;
};

}  // namespace indurop::robot
