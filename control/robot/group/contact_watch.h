// SPDX-License-Identifier: Apache-2.0
// Detects contact with the arm: the torque that the drives measure beyond what the arm needs for its motion (the
// residual). Motion is taken from measured positions, so a drive that lags behind does not count as contact.

#pragma once

#include <array>

#include "control/robot/kinematics/dynamics.h"

namespace indurop::robot {

class ContactWatch {
 public:
  ContactWatch() = default;
  // `limit`: N m for each axis, N for sliding ones.
  explicit ContactWatch(const Joints& limit) noexcept : limit_(limit), allowed_(limit) {}

  // Called while the drives have no power or move on their own. All functions of this class are real-time safe.
  void rest() noexcept;
  // Accepts a push that may last: only more than that counts from now on, until it is gone.
  void release() noexcept;
  // Takes the next period: the positions of the axes, and the torques of their drives, as means over the period.
  // Returns the first axis that is pushed, from 0; -1: none.
  int step(const Dynamics& dynamics, const Joints& q, const Joints& torque, double period) noexcept;
  // Returns the torque of the drives beyond what the arm needs, low-pass filtered.
  [[nodiscard]] const Joints& residual() const noexcept { return residual_; }

 private:
  [[nodiscard]] double allowed(const Dynamics& dynamics, const Joints& velocity, Eigen::Index axis) const noexcept;

  Joints limit_ = Joints::Zero();
  Joints allowed_ = Joints::Zero();
  std::array<Joints, 3> q_;  // the latest first
  Joints torque_ = Joints::Zero();
  Joints residual_ = Joints::Zero();
  std::array<int, kAxes> beyond_{};  // periods
  double awake_ = 0;                 // s
  int known_ = 0;                    // number of known q_
};

}  // namespace indurop::robot
