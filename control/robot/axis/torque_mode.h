// SPDX-License-Identifier: Apache-2.0
// A single axis that pushes with a torque. It comes to rest, its drive changes to the cyclic torque mode, and from then
// on set points are the position of the axis, so that it can brake from there at any time: by any other command, or
// because it is too fast or too near its end.

#pragma once

#include "control/robot/axis/bounds.h"
#include "control/robot/axis/drive.h"
#include "control/robot/axis/order.h"
#include "control/robot/axis/torque_control.h"
#include "control/robot/axis/units.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

class TorqueMode {
 public:
  // The measured state of the axis.
  struct Measured {
    double position = 0;
    double speed = 0;
  };
  // Permits pushing with up to `most`, in N m or N; 0: the torque unit of its drive is unknown.
  void allow(double most) noexcept { most_torque_ = most; }
  // Takes the drive's status. Returns true if the drive does not leave torque mode: it follows no set point, so that
  // its power has to be switched off for its brake to hold the axis. Real-time safe, like all functions of this class.
  bool sense(const DriveIn& in, double seconds) noexcept;

  // Converts a command into an order. `speed`: of the axis. Errors: Value, NoTorque, Torque.
  [[nodiscard]] ErrorCode resolve(const Command& command, double speed, AxisOrder& order) const noexcept;
  // Begins to push, or pushes with another torque. `speed`: measured.
  void begin(const AxisOrder& order, double speed) noexcept;
  // The drive follows set points again. Returns whether the axis has pushed, and has to brake from its present state.
  bool leave(Drive& drive) noexcept;
  // Changes the mode of a drive that is at rest. Errors: Drive (it has not left torque mode yet), NoTorque (it has not
  // entered it in time).
  ErrorCode prepare(Drive& drive, bool at_rest, double seconds) noexcept;
  // Computes the torque of the next period, while it pushes. Errors: Drive (the drive has changed its mode on its own),
  // Speed (too fast), JointLimit (too near its end).
  ErrorCode step(const Measured& now, const AxisBounds& bounds, double resolution, double seconds) noexcept;
  // Returns the position that the axis will have when the drive takes the set point.
  [[nodiscard]] double ahead(const Measured& now, double seconds) const noexcept {
    return now.position + now.speed * (push_.late() * seconds);
  }
  void set_override(double part) noexcept { push_.set_override(part); }
  void carry(const TorqueControl::Load& load) noexcept { push_.carry(load); }

  [[nodiscard]] bool on() const noexcept { return push_.on(); }
  [[nodiscard]] bool pushes() const noexcept { return push_.pushes(); }
  [[nodiscard]] bool reached() const noexcept { return push_.reached(); }
  [[nodiscard]] double torque() const noexcept { return push_.torque(); }
  // Returns whether the set point of this period is the drive's position.
  [[nodiscard]] bool led_by_drive() const noexcept { return led_by_drive_; }

 private:
  bool too_fast(double speed, double most, double resolution, double seconds) noexcept;
  [[nodiscard]] bool rests_in_time(const Measured& now, const AxisBounds& bounds, double ahead) const noexcept;

  TorqueControl push_;
  double most_torque_ = 0;
  bool led_by_drive_ = false;
  bool in_mode_ = false;     // whether the drive is in torque mode
  double waited_ = 0;        // s, for a change of its mode
  int late_ = 0;             // periods, for a change of its mode
  double slowing_from_ = 0;  // rad/s or m/s: its speed when it got another velocity
  double slowing_ = 0;       // s since then
  int too_fast_ = 0;         // number of periods
};

}  // namespace indurop::robot
