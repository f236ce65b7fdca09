// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics, from the tool's pose to joint angles: in closed form if the arm has one, else by iteration. Axes
// of the workpiece keep their values, and so do the redundant ones of an arm.

#pragma once

#include "control/robot/kinematics/numeric.h"
#include "control/robot/kinematics/parallel_axes.h"
#include "control/robot/kinematics/spherical_wrist.h"

namespace indurop::robot {

class Inverse {
 public:
  explicit Inverse(const Arm& arm);

  struct Result {
    Reach reach = Reach::OutOfReach;
    Solution solution;
  };
  // The solution nearest to `near`; with `posture` only the solution of that posture (one of eight). For an arm without
  // a closed form it iterates from `near`, which has to be as close as neighbouring places on a path are. Real-time
  // safe.
  [[nodiscard]] Result nearest(const Pose& pose, const Joints& near,
                               std::optional<std::uint8_t> posture = std::nullopt) const noexcept;
  // The same, chosen from solutions that were found earlier.
  [[nodiscard]] Result nearest(const Solutions& known, const Joints& near,
                               std::optional<std::uint8_t> posture) const noexcept;
  // All solutions in closed form, with the axes of the workpiece as in `near`; only the nearest one for an arm without
  // a closed form. Real-time safe.
  [[nodiscard]] Solutions all(const Pose& pose, const Joints& near) const noexcept;
  // All solutions of any arm; takes milliseconds if there is no closed form.
  [[nodiscard]] Solutions search(const Pose& pose, const Joints& near, const Search& how = {}) const noexcept;

  // The solution for a pose that need not be near on a path: an arm without a closed form begins at `near`, and moves
  // its elbow if that is needed, see solve_freely(). Real-time safe.
  [[nodiscard]] Result reach(const Pose& pose, const Joints& near) const noexcept;

  // Returns whether the arm has a closed form while the workpiece stands still.
  [[nodiscard]] bool closed_form() const noexcept { return wrist_ || parallel_; }
  // Returns whether the arm has named postures (different ways to reach the same pose).
  [[nodiscard]] bool has_postures() const noexcept { return postures_.has_value(); }
  // The posture in which the arm is there; nothing if it has none.
  [[nodiscard]] std::optional<std::uint8_t> posture_at(const Joints& q) const noexcept;
  // The axes that a pose leaves undetermined.
  [[nodiscard]] Held held() const noexcept { return held_; }
  // Returns whether axes that move the workpiece are not among these.
  [[nodiscard]] bool leaves_workpiece_open(Held given) const noexcept { return (workpiece_ & ~given) != 0; }
  // Returns `near` with the axes that a pose leaves undetermined set to their values in `from`: along a line they have
  // these values, whatever the place before was.
  [[nodiscard]] Joints held_as(const Joints& from, const Joints& near) const noexcept {
    return held_ == 0 ? near : with_axes(held_, from, near);
  }
  // Text for the user, such as "spherical wrist, inverse kinematics in closed form".
  [[nodiscard]] const char* kind() const noexcept;

 private:
  [[nodiscard]] Solutions solve(const Pose& pose, const Joints& near, Gathered::What what) const noexcept;
  [[nodiscard]] Solutions solve_in_world(const Pose& pose, const Joints& near, Gathered::What what) const noexcept;

  const Arm& arm_;
  Arm serial_;                           // without the axes of the workpiece
  std::optional<SphericalWrist> wrist_;  // of `serial_`, as all of these
  std::optional<ParallelAxes> parallel_;
  std::optional<Postures> postures_;
  Held held_;
  Held workpiece_;
};

}  // namespace indurop::robot
