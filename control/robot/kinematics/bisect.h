// SPDX-License-Identifier: Apache-2.0
// Bisection: where a condition that holds on one side of a place ends to hold.

#pragma once

namespace indurop::robot {

// The last argument for which the condition holds, and the first one for which it does not, as far as they are known.
struct Bisected {
  double holds = 0;
  double fails = 0;
  [[nodiscard]] double middle() const noexcept { return (holds + fails) / 2; }
};

// Halves the distance `most` times, as long as `goes_on(Bisected)`. Real-time safe if both functions are.
template <class Condition, class GoesOn>
Bisected bisect(Bisected between, int most, const Condition& holds, const GoesOn& goes_on) noexcept {
  for (int i = 0; i < most && goes_on(between); ++i) {
    const double middle = between.middle();
    if (holds(middle)) {
      between.holds = middle;
    } else {
      between.fails = middle;
    }
  }
  return between;
}

template <class Condition>
Bisected bisect(const Bisected& between, int most, const Condition& holds) noexcept {
  return bisect(between, most, holds, [](const Bisected&) { return true; });
}

}  // namespace indurop::robot
