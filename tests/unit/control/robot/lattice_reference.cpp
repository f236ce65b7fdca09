// SPDX-License-Identifier: Apache-2.0
#include "lattice_reference.h"

#include <algorithm>
#include <cstdlib>

namespace indurop::robot {

Lattice::Lattice(int acceleration, int speed, int steps) : most_(acceleration), fastest_(speed) {
  const auto states = static_cast<std::size_t>((2 * most_ + 1) * (2 * fastest_ + 1));
  farthest_.assign(1, std::vector<int>(states, kNever));
  farthest_[0][index(0, 0)] = 0;
  for (int step = 1; step <= steps; ++step) {
    const std::vector<int>& rest = farthest_.back();
    std::vector<int> now(states, kNever);
    for (int a = -most_; a <= most_; ++a) {
      for (int v = -fastest_; v <= fastest_; ++v) {
        for (int jerk = -1; jerk <= 1; ++jerk) {
          const int next = v + 2 * a + jerk;
          if (inside(a + jerk, next) && rest[index(a + jerk, next)] != kNever) {
            int& best = now[index(a, v)];
            best = std::max(best, 3 * v + 3 * a + jerk + rest[index(a + jerk, next)]);
          }
        }
      }
    }
    farthest_.push_back(std::move(now));
  }
}

bool Lattice::inside(int acceleration, int speed) const {
  return std::abs(acceleration) <= most_ && std::abs(speed) <= fastest_;
}

std::size_t Lattice::index(int acceleration, int speed) const {
  return static_cast<std::size_t>((acceleration + most_) * (2 * fastest_ + 1) + speed + fastest_);
}

int Lattice::farthest(std::size_t step, int acceleration, int speed) const {
  return farthest_[step][index(acceleration, speed)];
}

int Lattice::steps_to(int acceleration, int speed, int place) const {
  for (std::size_t step = 0; step < farthest_.size(); ++step) {
    const int far = farthest(step, acceleration, speed);
    const int near = farthest(step, -acceleration, -speed);  // in the mirror
    if (far != kNever && near != kNever && place <= far && place >= -near) {
      return static_cast<int>(step);
    }
  }
  return -1;
}

}  // namespace indurop::robot
