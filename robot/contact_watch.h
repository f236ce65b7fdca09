// SPDX-License-Identifier: Apache-2.0
// Tells whether something pushes against the arm: what the drives measure as torque, beyond what the arm needs for how
// it moves (the residual). Motion is taken from measured places, so a drive that lags behind is no push.

#pragma once

#include <array>

#include "robot/dynamics.h"

namespace indurop::robot {

class ContactWatch {
 public:
  ContactWatch() = default;
  // `limit`: N m of each axis, N of sliding ones.
  explicit ContactWatch(const Joints& limit) noexcept : limit_(limit), allowed_(limit) {}

  // The drives have no power, or move by themselves. Real-time safe, as all here.
  void rest() noexcept;
  // Somebody knows of a push that may last: only more than that counts from now on, until it is gone.
  void release() noexcept;
  // The next period: where the axes are, and the torques of their drives, means of the period. The first axis that is
  // pushed, from 0; -1: none.
  int step(const Dynamics& dynamics, const Joints& q, const Joints& torque, double period) noexcept;
  // What the drives give beyond what the arm needs, without what changes quickly.
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
  int known_ = 0;                    // of q_
};

}  // namespace indurop::robot
