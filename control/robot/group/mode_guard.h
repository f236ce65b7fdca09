// SPDX-License-Identifier: Apache-2.0
// Operating modes (ISO 10218-1). In manual mode neither the tool's tip nor the arm's end is faster than 250 mm/s, and
// everything comes to rest when the enabling switch is released. A stopped motion continues only on request.

#pragma once

#include "control/robot/group/enabling_switch.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class ModeGuard {
 public:
  explicit ModeGuard(const Robot& robot) noexcept : robot_(robot) {}

  // Reads the request of this period. Returns why the robot has to come to rest now; Ok: it does not. Real-time safe,
  // like all functions of this class.
  ErrorCode step(const ModeRequest& request) noexcept;
  [[nodiscard]] OperatingMode mode() const noexcept { return mode_; }
  // Ok, or why no motion is permitted; the same for motions of single axes.
  [[nodiscard]] ErrorCode permit() const noexcept { return permit_; }
  [[nodiscard]] ErrorCode axis_permit() const noexcept;
  [[nodiscard]] bool permits_jogging() const noexcept {
    return permit_ == ErrorCode::Ok && mode_ != OperatingMode::Automatic;
  }

  [[nodiscard]] bool permits_guiding() const noexcept {
    return permit_ == ErrorCode::Ok && mode_ == OperatingMode::Manual;
  }

  // Speed limit of the tip and of the arm's end in m/s; HUGE_VAL: none.
  [[nodiscard]] double tip_limit(bool jogging) const noexcept;
  // For single axes: the part of their full speed at which the tip and the arm's end keep the limit, even if all
  // moving axes are as fast as they can be.
  [[nodiscard]] double axes_pace(bool jogging) const noexcept;
  // The same for a sliding axis that belongs to no group; others of these may be at full speed.
  [[nodiscard]] double single_pace(int axis) const noexcept;
  // The check of the last gate, for the set points that are about to be sent. `off_path`: something moves them away
  // from the planned path.
  [[nodiscard]] bool tip_too_fast(bool off_path) const noexcept;

 private:
  [[nodiscard]] bool at_standstill() const noexcept;
  [[nodiscard]] bool reduced(bool jogging) const noexcept { return jogging || mode_ == OperatingMode::Manual; }

  const Robot& robot_;
  OperatingMode mode_ = OperatingMode::Any;
  EnablingSwitch enabling_switch_;
  ErrorCode permit_ = ErrorCode::Ok;
};

}  // namespace indurop::robot
