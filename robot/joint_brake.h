// SPDX-License-Identifier: Apache-2.0
// Brings joints to rest that cannot follow their path any more: all of them in step, on the way that their last set
// points have begun. If each one braked by itself, one would stop before another, and the tool could get faster.

#pragma once

#include <array>

#include "robot/path_brake.h"

namespace indurop::robot {

class JointBrake final : private PathAhead {
 public:
  explicit JointBrake(const JointLimits& limits) noexcept : brake_(limits) {}

  // `past`: the last set points, the latest first, one each `period` s. `hardness` as of PathBrake. Real-time safe, as
  // all here.
  void begin(const std::array<Joints, 3>& past, double period, double hardness) noexcept;
  // The next set point. Where the limits cannot be kept on this way it breaks them least, so it has to be checked.
  [[nodiscard]] const Joints& next() noexcept;

 private:
  Reach joints_ahead(double distance, const Joints& near, Joints& q) const noexcept override;
  [[nodiscard]] bool has_shape() const noexcept override { return true; }
  [[nodiscard]] Shape shape_ahead(double distance) const noexcept override;
  [[nodiscard]] double left() const noexcept override { return HUGE_VAL; }

  PathBrake brake_;
  PathHistory past_;
  // Places are seconds, as if nothing braked.
  Joints from_ = Joints::Zero(), velocity_ = Joints::Zero(), acceleration_ = Joints::Zero();
  double period_ = 0.01;
  double place_ = 0;
};

}  // namespace indurop::robot
