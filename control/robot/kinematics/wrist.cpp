// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/wrist.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/angles.h"

namespace indurop::robot {

Wrist::Wrist(const Vec3& first, const Vec3& middle, const Vec3& last) noexcept
    : first_(first),
      middle_(middle),
      last_(last),
      cosine_(first.dot(last) - first.dot(middle) * middle.dot(last)),
      sine_(first.dot(middle.cross(last))),
      constant_(first.dot(middle) * middle.dot(last)) {}

double Wrist::straight() const noexcept {
  return std::atan2(sine_, cosine_);
}

// Angle from straight; if it is small, its cosine is not accurate enough.
std::optional<double> Wrist::bent_by(const Vec3& wanted) const noexcept {
  constexpr double kAligned = 1e-12;
  const double most = std::hypot(cosine_, sine_);
  const double cosine = first_.dot(wanted);
  if (std::abs(most + constant_ - 1) < kAligned && cosine > constant_) {
    return 2 * std::asin(std::min(1.0, (first_ - wanted).norm() / (2 * std::sqrt(most))));
  }
  return angle_with_cosine((cosine - constant_) / most);
}

std::optional<Wrist::Angles> Wrist::turn(const Mat3& rotation, bool other, const Keep& keep) const noexcept {
  const Vec3 wanted = rotation * last_;
  const auto half = bent_by(wanted);
  if (!half) {
    return std::nullopt;
  }
  Angles angles;
  angles.middle = straight() + (other ? -*half : *half);
  const Mat3 bend = turned(middle_, angles.middle);
  const Vec3 bent = bend * last_;
  // Uses a vector perpendicular to an axis to measure the rotation about it.
  const auto turn_of = [](const Vec3& axis, const Mat3& by) {
    const Vec3 mark = axis.unitOrthogonal();
    return angle_about(axis, mark, by * mark);
  };
  const bool singular = first_.cross(bent).norm() < Close::kSingular;
  if (singular && !keep.first) {
    angles.last = keep.angle;
    angles.first = turn_of(first_, rotation * (bend * turned(last_, angles.last)).transpose());
    return angles;
  }
  angles.first = singular ? keep.angle : angle_about(first_, bent, wanted);
  angles.last = turn_of(last_, (turned(first_, angles.first) * bend).transpose() * rotation);
  return angles;
}

}  // namespace indurop::robot
