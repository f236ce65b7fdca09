// SPDX-License-Identifier: Apache-2.0
// Arms of six turning axes with three parallel ones: inverse kinematics in closed form with up to eight solutions. Axes
// are treated as lines in space, so it does not matter how a file describes them.

#pragma once

#include "control/robot/kinematics/angles.h"
#include "control/robot/kinematics/solutions.h"
#include "control/robot/kinematics/wrist.h"

namespace indurop::robot {

// Arms whose second, third and fourth axes are parallel and whose last two meet (UR type). The offsets between them may
// be any.
class ParallelAxes {
 public:
  // Returns nothing if the arm is of another kind.
  static std::optional<ParallelAxes> of(const Arm& arm);

  // As for SphericalWrist.
  [[nodiscard]] Solutions solve(const Arm& arm, const Pose& pose, const Joints& near,
                                Gathered::What what = Gathered::What::All) const noexcept;

 private:
  struct Search;
  void with_first(Search& search, double q1, std::uint8_t posture) const noexcept;
  void with_wrist(Search& search, const Wrist::Angles& wrist, std::uint8_t posture) const noexcept;

  Vec3 center_ = Vec3::Zero();  // where the last two axes meet, with all joints at zero
  Vec3 plane_x_, plane_y_;      // of the plane perpendicular to the parallel axes
  Eigen::Vector2d origin_;      // axis 2 in that plane
  Compass compass_;             // from there to axis 3, from there to axis 4
  double third_sign_ = 1;       // axis 3 points as axis 2 does, or against it
  double fourth_sign_ = 1;
  Wrist wrist_;  // the sum of the parallel ones, axis 5, axis 6
};

}  // namespace indurop::robot
