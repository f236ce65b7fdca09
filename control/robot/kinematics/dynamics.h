// SPDX-License-Identifier: Apache-2.0
// Inverse dynamics of an arm: torques of its axes (forces of sliding ones) from the masses of its links and of its
// payload, by Newton-Euler recursion over the links. It is independent of paths.

#pragma once

#include <array>
#include <vector>

#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/body.h"

namespace indurop::robot {

// Friction, one value for each axis.
struct Friction {
  Joints damping = Joints::Zero();  // N m s/rad, or N s/m
  Joints dry = Joints::Zero();      // N m, or N
};

class Dynamics {
 public:
  // Creates unknown dynamics.
  Dynamics() = default;
  // `bodies`: the body that each of the `links` moves, in the base's frame with all joints at zero; at most
  // Arm::kMostLinks. `end`: the arm's end in the same frame. `effort`: maximum of each axis; 0: no limit is known.
  Dynamics(const std::vector<Link>& links, const std::vector<Body>& bodies, const Pose& end, const Friction& friction,
           const Joints& effort) noexcept;

  // Real-time safe, like all functions below.
  [[nodiscard]] bool known() const noexcept { return count_ > 0; }
  [[nodiscard]] const Joints& effort() const noexcept { return effort_; }
  // Returns whether any axis has a torque limit.
  [[nodiscard]] bool limited() const noexcept { return (effort_.array() > 0).any(); }
  // Sets the inertia of the motors' rotors, gears included, as felt at the axes: kg m2, kg for sliding axes. The
  // effects that rotors have on each other by turning are neglected, as is usual for high gear ratios.
  void turn_rotors(const Joints& inertia) noexcept { rotors_ = inertia; }
  // Sets the payload, in the frame of the arm's end; mass 0: none.
  void hold(const Body& payload) noexcept;

  // Returns the drive torques for this motion, including gravity, without friction.
  [[nodiscard]] Joints torques(const Joints& q, const Joints& velocity, const Joints& acceleration) const noexcept {
    return torques(q, velocity, acceleration, kGravity);
  }
  // Returns the part of these torques that accelerations alone need.
  [[nodiscard]] Joints inertial(const Joints& q, const Joints& acceleration) const noexcept {
    return torques(q, Joints::Zero(), acceleration, 0);
  }
  // Returns the friction torques at this velocity.
  [[nodiscard]] Joints friction(const Joints& velocity) const noexcept;
  [[nodiscard]] const Friction& friction() const noexcept { return friction_; }

 private:
  static constexpr double kGravity = 9.80665;  // m/s^2, along -z of the base
  using Bodies = std::array<Body, Arm::kMostLinks>;

  [[nodiscard]] Joints torques(const Joints& q, const Joints& velocity, const Joints& acceleration,
                               double gravity) const noexcept;

  std::size_t count_ = 0;
  std::array<Link, Arm::kMostLinks> links_{};
  Bodies bodies_{};
  Body last_;  // the last body, without payload
  Pose end_;
  Friction friction_;
  Joints effort_ = Joints::Zero();
  Joints rotors_ = Joints::Zero();
};

}  // namespace indurop::robot
