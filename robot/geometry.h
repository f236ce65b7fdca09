// SPDX-License-Identifier: Apache-2.0
// The words of robot geometry: fixed-size Eigen types, so that nothing here ever allocates. Metres and radians.

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <initializer_list>
#include <numbers>

namespace indurop::robot {

// Room for that many; an arm may have fewer, and what the others stand at counts for nothing.
inline constexpr int kAxes = 8;
inline constexpr double kPi = std::numbers::pi;

using Joints = Eigen::Matrix<double, kAxes, 1>;
using Jacobian = Eigen::Matrix<double, 6, kAxes>;  // rows: linear velocity, then angular
using Twist = Eigen::Matrix<double, 6, 1>;         // linear, then angular
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

inline constexpr double radians(double degrees) noexcept {
  return degrees * kPi / 180;
}
inline constexpr double degrees(double radians) noexcept {
  return radians * 180 / kPi;
}

// The index of an axis, for containers.
constexpr std::size_t at(int axis) noexcept {
  return static_cast<std::size_t>(axis);
}

// The first axes; the others are at 0.
Joints joints_of(std::initializer_list<double> first) noexcept;

struct Pose {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
};

// What `second` is, seen from the frame in which `first` is.
inline Pose operator*(const Pose& first, const Pose& second) noexcept {
  return {first.position + first.orientation * second.position, (first.orientation * second.orientation).normalized()};
}

// The rotation vector (axis times angle, at most pi) that turns `from` into `to`, in coordinates of `from`.
Vec3 rotation_between(const Quat& from, const Quat& to) noexcept;
// The rotation by a rotation vector.
Quat rotation_by(const Vec3& vector) noexcept;
// Roll, pitch and yaw as in URDF: first about x, then y, then z of the fixed frame.
Quat from_rpy(const Vec3& rpy) noexcept;
// Pitch is from -90 to 90 degrees; at these two ends roll is 0.
Vec3 to_rpy(const Quat& orientation) noexcept;
// What it takes to come from `from` to `to`: metres, and radians in the base's frame.
Twist difference(const Pose& from, const Pose& to) noexcept;

}  // namespace indurop::robot
