// SPDX-License-Identifier: Apache-2.0
// What it takes to move an arm: torques of its axes (forces of sliding ones) from the masses of its links and of what
// it holds, by Newton and Euler from one link to the next. It knows nothing of paths.

#pragma once

#include <array>
#include <vector>

#include "robot/arm.h"
#include "robot/body.h"

namespace indurop::robot {

// Of the axes, one each.
struct Friction {
  Joints damping = Joints::Zero();  // N m s/rad, or N s/m
  Joints dry = Joints::Zero();      // N m, or N
};

class Dynamics {
 public:
  // Nothing is known.
  Dynamics() = default;
  // `bodies`: what each of the `links` moves, in the base's frame with all joints at zero; Arm::kMostLinks at most.
  // `end`: the arm's end, there. `effort`: the most of each axis; 0: no limit is known.
  Dynamics(const std::vector<Link>& links, const std::vector<Body>& bodies, const Pose& end, const Friction& friction,
           const Joints& effort) noexcept;

  // Real-time safe, as all the rest.
  [[nodiscard]] bool known() const noexcept { return count_ > 0; }
  [[nodiscard]] const Joints& effort() const noexcept { return effort_; }
  // Whether the torque of an axis has a limit.
  [[nodiscard]] bool limited() const noexcept { return (effort_.array() > 0).any(); }
  // Inertia of the motors' rotors, gears included, as their axes feel it: kg m2, kg of sliding axes. What they do to
  // each other by turning is left out, as is usual for gears of high ratio.
  void turn_rotors(const Joints& inertia) noexcept { rotors_ = inertia; }
  // What the arm holds, seen from its end; a mass of 0: nothing.
  void hold(const Body& payload) noexcept;

  // What the drives have to give for this motion, against gravity too, without friction.
  [[nodiscard]] Joints torques(const Joints& q, const Joints& velocity, const Joints& acceleration) const noexcept {
    return torques(q, velocity, acceleration, kGravity);
  }
  // That part of it which accelerations alone need.
  [[nodiscard]] Joints inertial(const Joints& q, const Joints& acceleration) const noexcept {
    return torques(q, Joints::Zero(), acceleration, 0);
  }
  // What friction adds at that velocity.
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
  Body last_;  // without what it holds
  Pose end_;
  Friction friction_;
  Joints effort_ = Joints::Zero();
  Joints rotors_ = Joints::Zero();
};

}  // namespace indurop::robot
