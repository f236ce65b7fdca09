// SPDX-License-Identifier: Apache-2.0
// Brings joints to rest that can no longer follow their path: all of them in step, along the motion that their last set
// points began. If each joint braked on its own, one would stop before another, and the tool could get faster.

#pragma once

#include <array>

#include "control/robot/path/brake.h"

namespace indurop::robot {

class JointBrake final : private PathAhead {
 public:
  explicit JointBrake(const JointLimits& limits) noexcept : brake_(limits) {}

  // Begins to brake. `past`: the last set points, the latest first, one each `period` s. `hardness` as in PathBrake.
  // Real-time safe, like all functions of this class.
  void begin(const std::array<Joints, 3>& past, double period, double hardness) noexcept;
  // Returns the next set point. Where the limits cannot be kept on this path it violates them as little as possible, so
  // the set point has to be checked.
  [[nodiscard]] const Joints& next() noexcept;

 private:
  Reach joints_ahead(double distance, const Joints& near, Joints& q) const noexcept override;
  [[nodiscard]] bool has_shape() const noexcept override { return true; }
  [[nodiscard]] Shape shape_ahead(double distance) const noexcept override;
  [[nodiscard]] double left() const noexcept override { return HUGE_VAL; }

  PathBrake brake_;
  PathHistory past_;
  // Places on the path are seconds of the motion without braking.
  Joints from_ = Joints::Zero(), velocity_ = Joints::Zero(), acceleration_ = Joints::Zero();
  double period_ = 0.01;
  double place_ = 0;
};

}  // namespace indurop::robot
