// SPDX-License-Identifier: Apache-2.0
// Arms of six turning axes whose last three axes meet in a point: inverse kinematics in closed form with up to eight
// solutions. Axes are treated as lines in space, so it does not matter how a file describes them.

#pragma once

#include "control/robot/kinematics/angles.h"
#include "control/robot/kinematics/solutions.h"
#include "control/robot/kinematics/wrist.h"

namespace indurop::robot {

// Arms whose last three axes meet in a point, whose second and third are parallel, and whose first is perpendicular to
// these: nearly all industrial ones. Shoulder, elbow and tool may have any offsets.
class SphericalWrist {
 public:
  // Returns nothing if the arm is of another kind.
  static std::optional<SphericalWrist> of(const Arm& arm);

  // Returns all solutions within the joint limits, each angle in the turn nearest to that of `near`. In singular
  // positions, where there are infinitely many, it returns those that keep the joints of `near`. What::Nearest: only
  // the nearest solution counts.
  [[nodiscard]] Solutions solve(const Arm& arm, const Pose& pose, const Joints& near,
                                Gathered::What what = Gathered::What::All) const noexcept;

 private:
  struct Search;
  void with_first(Search& search, double q1, std::uint8_t posture) const noexcept;
  void with_arm(Search& search, const Eigen::Vector3d& first_three, std::uint8_t posture) const noexcept;

  Vec3 center_ = Vec3::Zero();  // of the wrist, with all joints at zero
  Vec3 plane_x_, plane_y_;      // of the plane perpendicular to axes 2 and 3
  Eigen::Vector2d origin_;      // axis 2 in that plane
  Compass compass_;             // from there to axis 3, from there to the wrist
  double third_sign_ = 1;       // axis 3 points as axis 2 does, or against it
  Wrist wrist_;
};

}  // namespace indurop::robot
