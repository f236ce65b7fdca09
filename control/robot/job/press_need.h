// SPDX-License-Identifier: Apache-2.0
// What a tool that presses lacks, in one direction.

#pragma once

#include <array>
#include <cmath>

namespace indurop::robot {

// How far a tool is from where it would press as it should.
struct PressNeed {
  double missing = 0;    // m, by the stiffness of the contact
  bool touches = false;  // it presses already
};

// Along x, y and z of its axes.
using PressNeeds = std::array<PressNeed, 3>;

// `wanted`, `measured`: N; `stiffness`: N/m. Real-time safe.
[[nodiscard]] inline PressNeed press_need(double wanted, double measured, double stiffness) noexcept {
  constexpr double kTouch = 0.2;  // part of the wanted force from which on the tool is in contact
  return {(wanted - measured) / stiffness, std::copysign(measured, wanted * measured) >= kTouch * std::abs(wanted)};
}

}  // namespace indurop::robot
