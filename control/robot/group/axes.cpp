// SPDX-License-Identifier: Apache-2.0
// The single axes: the order in which they move on their own, and the check that they follow.

#include <algorithm>
#include <cmath>

#include "control/robot/group/group.h"

namespace indurop::robot {

// Moves each axis after the one that it follows; there are no cycles.
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

// Returns whether all axes are stopped for the emergency; axes that were reset one by one are stopped again.
bool Group::stopped_for_emergency() const noexcept {
  return error_ == ErrorCode::Emergency &&
         (to_error_ || std::all_of(axes().begin(), axes().end(),
                                   [](const AxisControl& a) { return a.state() == AxisState::ErrorStop; }));
}

bool Group::is_behind(const AxisControl& a) const noexcept {
  const double behind = std::abs(a.commanded().position - a.measured());
  return a.state() != AxisState::Homing && !a.pushes() && behind > a.unit() * parts_.settings.following_limit;
}

// Returns the first axis that is too far from its set point; -1: none.
int Group::axis_behind() const noexcept {
  const auto found = std::find_if(axes().begin(), axes().end(), [this](const AxisControl& a) { return is_behind(a); });
  return found == axes().end() ? -1 : static_cast<int>(found - axes().begin());
}

// Stops axes that lag while they move as single axes without power of the group; the others continue.
void Group::fail_axes_behind() noexcept {
  for (AxisControl& a : axes()) {
    if (a.state() != AxisState::ErrorStop && is_behind(a)) {
      a.fail(ErrorCode::Following, 1);
    }
  }
}

}  // namespace indurop::robot
