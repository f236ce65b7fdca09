// SPDX-License-Identifier: Apache-2.0
// From the tool's pose back to joint angles: in closed form where the arm has one, for any other step by step.

#pragma once

#include "robot/closed_forms.h"
#include "robot/numeric.h"

namespace indurop::robot {

class Inverse {
 public:
  explicit Inverse(const Arm& arm);

  struct Result {
    Reach reach = Reach::OutOfReach;
    Solution solution;
  };
  // The solution nearest to `near`; with `posture` only that one of the eight. An arm without a closed form goes on
  // from `near`, which has to be as close as places on a path are. Real-time safe.
  [[nodiscard]] Result nearest(const Pose& pose, const Joints& near,
                               std::optional<std::uint8_t> posture = std::nullopt) const noexcept;
  // The same among solutions that were found before.
  [[nodiscard]] Result nearest(const Solutions& known, const Joints& near,
                               std::optional<std::uint8_t> posture) const noexcept;
  // All solutions in closed form; of an arm without one only the nearest. Real-time safe.
  [[nodiscard]] Solutions all(const Pose& pose, const Joints& near) const noexcept;
  // All solutions of any arm; without a closed form it takes milliseconds.
  [[nodiscard]] Solutions search(const Pose& pose, const Joints& near, const Search& how = {}) const noexcept;

  [[nodiscard]] bool closed_form() const noexcept { return wrist_ || parallel_; }
  // Whether the arm can be held in different ways that have names.
  [[nodiscard]] bool has_postures() const noexcept { return postures_.has_value(); }
  // These joints with the axes that a pose leaves open where `from` has them: along a line they stand there, whatever
  // the place before it was.
  [[nodiscard]] Joints held_as(const Joints& from, Joints near) const noexcept;
  // "spherical wrist, inverse kinematics in closed form"
  [[nodiscard]] const char* kind() const noexcept;

 private:
  [[nodiscard]] Solutions solve(const Pose& pose, const Joints& near, Gathered::What what) const noexcept;

  const Arm& arm_;
  std::optional<SphericalWrist> wrist_;
  std::optional<ParallelAxes> parallel_;
  std::optional<Postures> postures_;
  Held held_;
};

}  // namespace indurop::robot
