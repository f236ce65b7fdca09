// SPDX-License-Identifier: Apache-2.0
// How a follower at rest comes into gear at a given place of its master: until `from` it stands, at `to` it has place
// and speed of the gear, and between them it goes where the master goes, on a curve without jumps of speed and
// acceleration.

#pragma once

#include <utility>

namespace indurop::robot {

class Approach {
 public:
  Approach() = default;
  // Places of the master are `from` and `to`, which differ; of the follower `start` and `end`. `slope`: what the
  // follower moves for each unit of its master from there on. Real-time safe, as all here.
  Approach(double from, double to, double start, double end, double slope) noexcept;

  [[nodiscard]] bool known() const noexcept { return known_; }
  // The master has not come to the end of it.
  [[nodiscard]] bool leads(double master) const noexcept { return known_ && part(master) < 1; }
  [[nodiscard]] double at(double master) const noexcept;
  // The least and the greatest place of the follower on the way.
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
