// SPDX-License-Identifier: Apache-2.0
// An enabling switch whose hand is far away: it counts as pressed only while its beat goes on.

#pragma once

#include <cstdint>
#include <optional>

namespace indurop::robot {

class DeadMan {
 public:
  // How long it stays pressed after the last beat.
  static constexpr double kPatience = 0.3;  // s

  // Once a period, of `period` seconds. `beat` 0: the hand is at the switch, which counts by itself. Else it has to
  // change within kPatience; once it has not, the switch has to be released before it counts again. Whoever finds a
  // switch pressed when he begins to look waits for that, too. Real-time safe.
  bool holds(bool pressed, std::uint32_t beat, double period) noexcept {
    const bool first = !last_;
    since_ = first || beat != *last_ ? 0 : since_ + period;
    last_ = beat;
    lapsed_ = pressed && beat != 0 && (lapsed_ || first || since_ > kPatience + period / 2);
    return pressed && !lapsed_;
  }

 private:
  std::optional<std::uint32_t> last_;
  double since_ = 0;
  bool lapsed_ = false;
};

}  // namespace indurop::robot
