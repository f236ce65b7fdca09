// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/guide_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace indurop::robot {

namespace {

constexpr double kMostHand = 600;         // N, more is no hand
constexpr double kLeastLever = 0.15;      // m, the least lever of a hand
constexpr int kMostRaw = 5000;            // thousandths of the rated torque that a drive can have
constexpr double kStaleTime = 0.5;        // s; hands tremble, so no torque stays the same that long
constexpr double kWeightTime = 0.5;       // s for which a weight acts steadily
constexpr double kWeightSteady = 0.05;    // part by which it may differ meanwhile
constexpr double kOtherForces = 0.2;      // part of the push that need not be weight
constexpr double kNewtonPerKg = 9.80665;  // m/s^2

}  // namespace

void GuideWatch::begin() noexcept {
  same_.setZero();
  weight_ = weighs_ = 0;
}

Fault GuideWatch::check_axis(const Seen& seen, int axis, double period) noexcept {
  const std::int16_t raw = seen.raw[at(axis)];
  same_[axis] = raw == last_[at(axis)] && seen.moving[axis] != 0 ? same_[axis] + period : 0;
  last_[at(axis)] = raw;
  const double lever = std::max(seen.end.col(axis).head<3>().norm(), kLeastLever);
  const char* why = nullptr;
  if (!std::isfinite(seen.push[axis])) {
    why = "is no number";
  } else if (std::abs(static_cast<int>(raw)) > kMostRaw || std::abs(seen.push[axis]) > kMostHand * lever) {
    why = "is more than a hand can push";
  } else if (same_[axis] >= kStaleTime) {
    why = "has not changed for 0.5 s";
  }
  if (why == nullptr) {
    return {};
  }
  std::snprintf(text_, sizeof text_, "guiding has ended: the torque that the drive of axis %d reports %s", axis + 1,
                why);
  return {ErrorCode::NoTorque, axis + 1};
}

// A weight at the arm's end pushes straight down or, if less is held than declared, up, and always with the same force.
bool GuideWatch::is_weight(const Seen& seen, int count, double period) noexcept {
  const Joints by_newton = seen.end.row(2).transpose();
  double both = 0;
  double size = 0;
  double all = 0;
  for (int i = 0; i < count; ++i) {
    both += by_newton[i] * seen.push[i];
    size += by_newton[i] * by_newton[i];
    all += seen.push[i] * seen.push[i];
  }
  const double force = size > 0 ? both / size : 0;
  const double rest = all - force * both;
  const bool moves = (seen.moving.array() != 0).any();
  if (!moves || rest > kOtherForces * kOtherForces * all) {
    weighs_ = 0;
    return false;
  }
  if (weighs_ == 0 || std::abs(force - weight_) > kWeightSteady * std::abs(weight_)) {
    weight_ = force;
    weighs_ = 0;
  }
  weighs_ += period;
  return weighs_ >= kWeightTime;
}

Fault GuideWatch::step(const Seen& seen, int count, double period) noexcept {
  for (int i = 0; i < count; ++i) {
    if (const Fault fault = check_axis(seen, i, period); !fault.ok()) {
      return fault;
    }
  }
  if (is_weight(seen, count, period)) {
    std::snprintf(text_, sizeof text_,
                  "guiding has ended: the arm %s, since it holds about %.1f kg %s than TOOL and LOAD say",
                  weight_ < 0 ? "sinks" : "rises", std::abs(weight_) / kNewtonPerKg, weight_ < 0 ? "more" : "less");
    return {ErrorCode::Contact, 0};
  }
  return {};
}

}  // namespace indurop::robot
