// SPDX-License-Identifier: Apache-2.0
// A reference for motions of one axis from any state to rest, written independently of control/robot/: in steps of
// one second with jerk -1, 0 or 1 acceleration, twice the speed and six times the place are whole numbers, so all
// motions can be gone through, exactly. How far one comes at most in so many steps and then rests is found backwards
// from rest. What lies between the farthest and the nearest place can be reached too, since means of motions keep all
// limits; so nothing optimal is slower than this, and it is faster by a few steps at most, which are coarse.

#pragma once

#include <vector>

namespace indurop::robot {

class Lattice {
 public:
  // Limits of acceleration and of twice the speed; motions of up to `steps`.
  Lattice(int acceleration, int speed, int steps);
  // The least number of steps from this acceleration and twice this speed to rest `place` / 6 further; -1: none.
  [[nodiscard]] int steps_to(int acceleration, int speed, int place) const;

 private:
  static constexpr int kNever = -1000000000;
  [[nodiscard]] bool inside(int acceleration, int speed) const;
  [[nodiscard]] std::size_t index(int acceleration, int speed) const;
  [[nodiscard]] int farthest(std::size_t step, int acceleration, int speed) const;

  int most_, fastest_;
  std::vector<std::vector<int>> farthest_;  // by steps and state: six times the way
};

}  // namespace indurop::robot
