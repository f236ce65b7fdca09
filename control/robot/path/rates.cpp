// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/rates.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kSpeed = 0.98;  // the fastest place lies between two checked ones

}  // namespace

double shared(double limit, double part) noexcept {
  return part > 1e-12 ? limit / part : HUGE_VAL;
}

Rates rates_at(const Joints* places, int count, int i, double spacing) noexcept {
  const int k = std::clamp(i, 1, count - 1);
  const int m = std::clamp(i, 1, count - 2);
  const Joints bend = places[m + 2] - 3 * places[m + 1] + 3 * places[m] - places[m - 1];
  return {(places[i + 1] - places[i]).cwiseAbs() / spacing,
          (places[k + 1] - 2 * places[k] + places[k - 1]).cwiseAbs() / (spacing * spacing),
          bend.cwiseAbs() / (spacing * spacing * spacing)};
}

double velocity_for(const Rates& rates, const JointLimits& joints, double most) noexcept {
  for (int a = 0; a < kAxes; ++a) {
    most = std::min({most, shared(kSpeed * joints.velocity[a], rates.first[a]),
                     std::sqrt(shared(Shares::kBending * joints.acceleration[a], rates.second[a])),
                     std::cbrt(shared(Shares::kBendingJerk * joints.jerk[a], rates.third[a]))});
  }
  return most;
}

void leave_for_changes(const Rates& rates, const JointLimits& joints, LineLimits& limits) noexcept {
  const double v = limits.velocity;
  for (int a = 0; a < kAxes; ++a) {
    const double left = joints.acceleration[a] - rates.second[a] * v * v;
    limits.acceleration = std::min({limits.acceleration, shared(left, rates.first[a]),
                                    shared(Shares::kMixedJerk / 3 * joints.jerk[a], rates.second[a] * v)});
    limits.jerk =
        std::min(limits.jerk, shared((1 - Shares::kBendingJerk - Shares::kMixedJerk) * joints.jerk[a], rates.first[a]));
  }
}

bool may_be_singular(const double* volume, int count, int i) noexcept {
  const double here = std::abs(volume[i]);
  const double next = std::abs(volume[i + 1]);
  const double before = std::abs(volume[std::max(i - 1, 0)]);
  const double behind = std::abs(volume[std::min(i + 2, count)]);
  const double fall = std::max({before - here, behind - next, std::abs(next - here)});
  return volume[i] * volume[i + 1] <= 0 || here + next - fall < 2.0 / 3 * std::min(here, next);
}

double pace(const Rates& rates, const JointLimits& joints) noexcept {
  return rates.first.cwiseQuotient(joints.velocity).maxCoeff();
}

LineLimits limits_along(const Joints* places, int count, double spacing, const JointLimits& joints,
                        const LineLimits& most) noexcept {
  LineLimits result = most;
  for (int i = 0; i < count; ++i) {
    result.velocity = velocity_for(rates_at(places, count, i, spacing), joints, result.velocity);
  }
  for (int i = 0; i < count; ++i) {
    leave_for_changes(rates_at(places, count, i, spacing), joints, result);
  }
  return result;
}

}  // namespace indurop::robot
