// SPDX-License-Identifier: Apache-2.0
// From the tool's pose back to joint angles: in closed form for arms with a spherical wrist (nearly all industrial
// ones), all up to eight solutions; for any other arm step by step with damped least squares. No allocation.

#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "robot/arm.h"

namespace indurop::robot {

// One way of holding the tool at a pose. The bits of `posture` tell the eight apart.
struct Solution {
  static constexpr std::uint8_t kShoulder = 1;  // arm reaches over its back
  static constexpr std::uint8_t kElbow = 2;     // the other elbow
  static constexpr std::uint8_t kWrist = 4;     // wrist turned over
  Joints q = Joints::Zero();
  std::uint8_t posture = 0;
};

enum class Reach { Ok, OutOfReach, JointLimit };

struct Solutions {
  std::array<Solution, 8> list;
  int count = 0;
  Reach reach = Reach::OutOfReach;  // Ok if count > 0; JointLimit: only the limits are in the way
};

// Arms whose last three axes meet in a point, whose second and third are parallel, and whose first is perpendicular to
// these. Shoulder, elbow and tool may have any offsets.
class SphericalWrist {
 public:
  // Nothing if the arm is of another kind.
  static std::optional<SphericalWrist> of(const Arm& arm);

  // All solutions within the joint limits, each angle the turn nearest to that of `near`. In singular positions, where
  // there are infinitely many, those that keep the joints of `near`.
  [[nodiscard]] Solutions solve(const Arm& arm, const Pose& pose, const Joints& near) const noexcept;

 private:
  struct Search;
  void with_first(Search& search, double q1, std::uint8_t posture) const noexcept;
  void with_arm(Search& search, const Eigen::Vector3d& first_three, std::uint8_t posture) const noexcept;

  Vec3 center_ = Vec3::Zero();                   // of the wrist, at joint angles zero
  Vec3 plane_x_, plane_y_;                       // of the plane perpendicular to axes 2 and 3
  Eigen::Vector2d origin_, upper_, lower_;       // in that plane: axis 2, from there to axis 3, from there to the wrist
  double third_sign_ = 1;                        // axis 3 points as axis 2 does, or against it
  double cosine_ = 0, sine_ = 0, constant_ = 0;  // axis 4 * (axis 6 turned by q5) = these * cos q5, sin q5, 1
};

class Inverse {
 public:
  explicit Inverse(const Arm& arm) : arm_(arm), wrist_(SphericalWrist::of(arm)) {}

  struct Result {
    Reach reach = Reach::OutOfReach;
    Solution solution;
  };
  // The solution nearest to `near`; with `posture` only that one of the eight.
  [[nodiscard]] Result nearest(const Pose& pose, const Joints& near,
                               std::optional<std::uint8_t> posture = std::nullopt) const noexcept;
  // All solutions in closed form; of an arm without one only the nearest.
  [[nodiscard]] Solutions all(const Pose& pose, const Joints& near) const noexcept;
  [[nodiscard]] bool closed_form() const noexcept { return wrist_.has_value(); }

 private:
  const Arm& arm_;
  std::optional<SphericalWrist> wrist_;
};

// Damped least squares from `near` on, within the limits; at most a hundred steps. Real-time safe.
Inverse::Result solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept;

}  // namespace indurop::robot
