// SPDX-License-Identifier: Apache-2.0
// Basic types and functions of robot geometry: fixed-size Eigen types, so that nothing in this file ever allocates.
// Units are metres and radians.

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <initializer_list>
#include <numbers>

namespace indurop::robot {

// Maximum number of axes. An arm may have fewer; the values of unused axes are ignored.
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

// Converts the index of an axis for use with containers.
constexpr std::size_t at(int axis) noexcept {
  return static_cast<std::size_t>(axis);
}

// Returns joint values of which the first ones are given; the others are 0.
Joints joints_of(std::initializer_list<double> first) noexcept;

struct Pose {
  Vec3 position = Vec3::Zero();
  Quat orientation = Quat::Identity();
};

// Composes poses: `second` is given in the frame of `first`.
inline Pose operator*(const Pose& first, const Pose& second) noexcept {
  return {first.position + first.orientation * second.position, (first.orientation * second.orientation).normalized()};
}
inline Pose inverse_of(const Pose& pose) noexcept {
  const Quat back = pose.orientation.conjugate();
  return {back * -pose.position, back};
}

// Rotation vector (axis times angle, at most pi) that turns `from` into `to`, in coordinates of `from`.
Vec3 rotation_between(const Quat& from, const Quat& to) noexcept;
// Rotation that belongs to a rotation vector.
Quat rotation_by(const Vec3& vector) noexcept;
// Converts roll, pitch and yaw as in URDF: about x first, then y, then z of the fixed frame.
Quat from_rpy(const Vec3& rpy) noexcept;
// Converts to roll, pitch and yaw. Pitch is from -90 to 90 degrees; at these two limits roll is 0.
Vec3 to_rpy(const Quat& orientation) noexcept;
// Displacement from `from` to `to`: metres, and radians in the base frame.
Twist difference(const Pose& from, const Pose& to) noexcept;

}  // namespace indurop::robot
