// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_findings.h"

#include <algorithm>

namespace indurop::robot {

PathFindings::PathFindings(const Places& places, Draft& draft) noexcept : places_(places), draft_(draft) {
  for (int i = 1; i <= 256; ++i) {
    usual_volume_ = std::max(usual_volume_, std::abs(places.arm().volume(places.arm().spread(i))));
  }
}

void PathFindings::begin() noexcept {
  const Segment& s = draft_.segment;
  bounds_.speed.fill(s.limits.velocity);
  bounds_.acceleration.fill(s.limits.acceleration);
  noted_ = 0;
  least_volume_ = std::abs(places_.arm().volume(s.from));
  slowest_ = HUGE_VAL;
  turns_at_end_ = false;
  narrow_.fill({0, s.from});
}

double PathFindings::bound_tool(double from, double to) noexcept {
  double lowest = HUGE_VAL;
  const int last = static_cast<int>(to * PathBounds::kParts);
  for (int i = static_cast<int>(from * PathBounds::kParts); i < last; ++i) {
    const LineLimits most = draft_.segment.chain->limits_at(draft_.segment.length * (i + 0.5) / PathBounds::kParts);
    bounds_.speed[static_cast<std::size_t>(i)] = most.velocity;
    bounds_.acceleration[static_cast<std::size_t>(i)] = most.acceleration;
    LineLimits& all = draft_.segment.limits;
    all = {std::min(all.velocity, most.velocity), std::min(all.acceleration, most.acceleration),
           std::min(all.jerk, most.jerk)};
    lowest = std::min(lowest, all.velocity);
  }
  return lowest;
}

void PathFindings::bound(const Rates& rates, double from, double length, const Joints& q) noexcept {
  constexpr double kChanging = 0.7;  // of a joint's acceleration
  const double part = draft_.segment.length / PathBounds::kParts;
  const int first = std::clamp(static_cast<int>(from / part + 0.001), 0, PathBounds::kParts - 1);
  const int last = std::clamp(static_cast<int>((from + length) / part - 0.001), first, PathBounds::kParts - 1);
  const double speed = velocity_for(rates, draft_.joints, HUGE_VAL);
  const double acceleration = kChanging / rates.first.cwiseQuotient(draft_.joints.acceleration).maxCoeff();
  if (speed < slowest_) {
    slowest_ = speed;
    narrow_[1] = {from, q};
  }
  for (int i = first; i <= last; ++i) {
    const auto k = static_cast<std::size_t>(i);
    bounds_.speed[k] = std::min(bounds_.speed[k], speed);
    bounds_.acceleration[k] = std::min(bounds_.acceleration[k], acceleration);
  }
}

void PathFindings::bound_all(const LineLimits& most) noexcept {
  for (std::size_t i = 0; i < bounds_.speed.size(); ++i) {
    bounds_.speed[i] = std::min(bounds_.speed[i], most.velocity);
    bounds_.acceleration[i] = std::min(bounds_.acceleration[i], most.acceleration);
  }
}

void PathFindings::note(const Rates& rates) noexcept {
  double& velocity = draft_.segment.limits.velocity;
  velocity = velocity_for(rates, draft_.joints, velocity);
  if (noted_ < rates_.size()) {
    rates_[noted_++] = rates;
    return;
  }
  Rates& last = rates_.back();
  last = {last.first.cwiseMax(rates.first), last.second.cwiseMax(rates.second), last.third.cwiseMax(rates.third)};
}

void PathFindings::note_volume(double volume, double place, const Joints& q) noexcept {
  if (std::abs(volume) < least_volume_) {
    least_volume_ = std::abs(volume);
    narrow_[0] = {place, q};
  }
}

// An axis that turns with its whole acceleration goes at most a third of acceleration^3 / jerk^2 further if it has to
// rest instead: the way in which it reduces that acceleration. Between two places it may turn somewhat later than here.
void PathFindings::note_turn(const Joints* q) noexcept {
  const JointLimits& joints = draft_.joints;
  for (int i = 0; i < places_.arm().count(); ++i) {
    const Axis& axis = places_.arm().axis(i);
    const double bend = q[2][i] - 2 * q[1][i] + q[0][i];
    if (axis.endless || (q[1][i] - q[0][i]) * (q[2][i] - q[1][i]) > 0) {
      continue;
    }
    const double room = bend < 0 ? axis.upper - q[1][i] : q[1][i] - axis.lower;
    const double most = std::pow(joints.acceleration[i], 3) / std::pow(joints.jerk[i], 2) / 3;
    turns_at_end_ = turns_at_end_ || room < most + std::abs(bend);
  }
}

void PathFindings::leave_for_changes() noexcept {
  for (std::size_t i = 0; i < noted_; ++i) {
    robot::leave_for_changes(rates_[i], draft_.joints, draft_.segment.limits);
  }
}

bool PathFindings::nearly_singular() const noexcept {
  constexpr double kNear = 0.1;
  return least_volume_ < kNear * usual_volume_;
}

}  // namespace indurop::robot
