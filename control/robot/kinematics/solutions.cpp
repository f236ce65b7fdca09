// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/solutions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/robot/kinematics/angles.h"

namespace indurop::robot {

ErrorCode code_of(Reach reach) noexcept {
  switch (reach) {
    case Reach::Ok:
      return ErrorCode::Ok;
    case Reach::OutOfReach:
      return ErrorCode::Unreachable;
    case Reach::JointLimit:
      return ErrorCode::JointLimit;
  }
  return ErrorCode::Unreachable;
}

void Solutions::add(const Arm& arm, const Joints& q, std::uint8_t posture, const Joints& near) noexcept {
  Solution one{q, posture};
  for (int i = 0; i < arm.count(); ++i) {
    const auto angle = turn_nearest(arm.axis(i), q[i], near[i]);
    if (!angle) {
      reach = count > 0 ? Reach::Ok : Reach::JointLimit;
      return;
    }
    one.q[i] = *angle;
  }
  if (count < static_cast<int>(list.size())) {
    list[static_cast<std::size_t>(count++)] = one;
  }
  reach = Reach::Ok;
}

FirstTurns::FirstTurns(const Eigen::Vector2d& point, double offset, bool front, double near) noexcept {
  const double radius = std::hypot(point.x(), point.y());
  if (radius < Close::kSingular) {
    if (std::abs(offset) < Close::kSingular) {
      turns_[count_++] = {near, 0};
    }
    return;
  }
  if (const auto half = angle_with_cosine(offset / radius)) {
    const double middle = std::atan2(point.y(), point.x());
    turns_[count_++] = {middle - *half, front ? std::uint8_t{0} : Solution::kShoulder};
    turns_[count_++] = {middle + *half, front ? Solution::kShoulder : std::uint8_t{0}};
    const auto away = [&](const Turn& turn) { return std::abs(std::remainder(turn.angle - near, 2 * kPi)); };
    if (away(turns_[1]) < away(turns_[0])) {
      std::swap(turns_[0], turns_[1]);
    }
  }
}

double Gathered::away(int axis, double angle) const noexcept {
  const double off = std::remainder(angle - near_[axis], 2 * kPi);
  return off * off;
}

void Gathered::add(const Joints& q, std::uint8_t posture) noexcept {
  const int before = found_.count;
  found_.add(arm_, q, posture, near_);
  if (what_ == What::Nearest && found_.count > before) {
    const Solution& one = found_.list[static_cast<std::size_t>(before)];
    nearest_ = std::min(nearest_, (one.q - near_).squaredNorm());
  }
}

const Solution* Solutions::nearest(const Joints& near, std::optional<std::uint8_t> posture) const noexcept {
  const Solution* best = nullptr;
  double distance = HUGE_VAL;
  for (int i = 0; i < count; ++i) {
    const Solution& one = list[static_cast<std::size_t>(i)];
    const double away = (one.q - near).squaredNorm();
    if (away < distance && (!posture || one.posture == *posture)) {
      distance = away;
      best = &one;
    }
  }
  return best;
}

}  // namespace indurop::robot
