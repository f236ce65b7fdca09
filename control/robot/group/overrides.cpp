// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/overrides.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

double Overrides::factor(double given) noexcept {
  const bool known = given >= 0 && std::isfinite(given);
  wrong_ = wrong_ || !known;
  return known ? std::min(given, 1.0) : 0;
}

void Overrides::step(const Inputs& in, bool interrupted, const ModeGuard& mode, bool jogging) noexcept {
  wrong_ = false;
  const double part = factor(in.speed_override / 100);
  const double of_group = part * factor(in.factors.group);
  const bool held = in.hold || interrupted;
  const bool rests = held || of_group < Follower::kStill;
  const double limit = mode.tip_limit(jogging);
  const double synced = jogging ? 1 : sync_.step(rests);
  robot_.follower.set_override(std::min(of_group * conveyor_.pace(), synced));
  robot_.follower.set_tip_limit(std::max(0.1 * limit, limit - conveyor_.speed() - correction_.speed()));
  robot_.follower.set_hold(held || (conveyor_.on() && !conveyor_.is_synchronized()));
  correction_.set_pace(rests ? 0 : of_group);
  conveyor_.set_paused(rests);
  const double slow = mode.axes_pace(jogging);
  for (int i = 0; i < robot_.count(); ++i) {
    AxisControl& a = robot_.axes[i];
    a.set_override(in.hold ? 0 : std::min(part * factor(in.factors.velocity[at(i)]), slow));
    a.set_factors(in.factors.acceleration[at(i)], in.factors.jerk[at(i)]);
  }
  for (int i = 0; i < robot_.singles.count(); ++i) {
    AxisControl& a = robot_.singles[i];
    const std::size_t k = at(robot_.count() + i);
    a.set_override(in.hold ? 0 : std::min(part * factor(in.factors.velocity[k]), mode.single_pace(i)));
    a.set_factors(in.factors.acceleration[k], in.factors.jerk[k]);
  }
}

}  // namespace indurop::robot
