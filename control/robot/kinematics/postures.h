// SPDX-License-Identifier: Apache-2.0
// The posture of a six-axis arm, determined from its joint angles: shoulder, elbow, wrist. Gives arms without a closed
// form the same posture bits as those with one.

#pragma once

#include <optional>

#include "control/robot/kinematics/angles.h"
#include "control/robot/kinematics/solutions.h"
#include "control/robot/kinematics/wrist.h"

namespace indurop::robot {

class Postures {
 public:
  // Returns nothing if axes 2 and 3 are not nearly parallel: such arms have no elbow.
  static std::optional<Postures> of(const Arm& arm);
  // Real-time safe.
  [[nodiscard]] std::uint8_t at(const Arm& arm, const Joints& q) const noexcept;

 private:
  int before_wrist_ = 3;         // number of axes that move the center
  Vec3 center_ = Vec3::Zero();   // of the wrist, at joint angles zero
  Vec3 across_ = Vec3::UnitX();  // from axis 1, in the plane of the arm
  double front_ = 1;             // side of the center at joint angles zero
  double straight_ = 0;          // of the elbow
  double third_sign_ = 1;
  double wrist_ = 0;  // axis 5, where the wrist may flip
};

}  // namespace indurop::robot
