// SPDX-License-Identifier: Apache-2.0
// The axes one by one: in which order they move by themselves, and which of them does not follow.

#include <algorithm>
#include <cmath>

#include "robot/group.h"

namespace indurop::robot {

namespace {

constexpr std::size_t at(int axis) noexcept {
  return static_cast<std::size_t>(axis);
}

}  // namespace

// Each one after the one that it follows; circles there are none.
void Group::move_axes() noexcept {
  std::array<bool, kAxes> moved{};
  for (int left = count(); left > 0;) {
    for (int i = 0; i < count(); ++i) {
      AxisControl& a = axes_[at(i)];
      const auto waits = [&moved](const AxisControl::Leader& leader) { return !moved[at(leader.axis)]; };
      if (moved[at(i)] || std::any_of(a.leaders().begin(), a.leaders().end(), waits)) {
        continue;
      }
      moved[at(i)] = true;
      --left;
      if (!a.in_group()) {
        a.move(period_);
      }
    }
  }
}

// The first axis that is too far from its set point; -1: none.
int Group::axis_behind() const noexcept {
  for (int i = 0; i < count(); ++i) {
    const AxisControl& a = axes_[at(i)];
    const double behind = std::abs(a.commanded().position - a.measured());
    if (a.state() != AxisState::Homing && !a.pushes() && behind > a.unit() * parts_.settings.following_limit) {
      return i;
    }
  }
  return -1;
}

}  // namespace indurop::robot
