// SPDX-License-Identifier: Apache-2.0
// How a follower at rest engages its gear at a given position of its master: until `from` it rests, at `to` it has the
// position and speed of the gear, and in between it moves with the master on a curve without jumps of speed and
// acceleration.

#pragma once

#include <utility>

namespace indurop::robot {

class Approach {
 public:
  Approach() = default;
  // `from` and `to` are positions of the master and must differ; `start` and `end` are positions of the follower.
  // `slope`: follower motion per unit of master motion from `to` on. All functions of this class are real-time safe.
  Approach(double from, double to, double start, double end, double slope) noexcept;

  [[nodiscard]] bool known() const noexcept { return known_; }
  // Returns true until the master has reached the end of the approach.
  [[nodiscard]] bool leads(double master) const noexcept { return known_ && part(master) < 1; }
  [[nodiscard]] double at(double master) const noexcept;
  // Returns the motion of the follower per unit of master motion.
  [[nodiscard]] double slope_at(double master) const noexcept;
  // Returns the greatest number that at() adds up.
  [[nodiscard]] double size() const noexcept;
  // Returns the smallest and the greatest position of the follower during the approach.
  [[nodiscard]] std::pair<double, double> extent() const noexcept;

 private:
  [[nodiscard]] double part(double master) const noexcept { return (master - from_) / length_; }
  [[nodiscard]] double curve(double part) const noexcept {
    return start_ + part * part * part * (third_ + part * (fourth_ + part * fifth_));
  }

  bool known_ = false;
  double from_ = 0, length_ = 1, start_ = 0;
  double third_ = 0, fourth_ = 0, fifth_ = 0;
};

}  // namespace indurop::robot
