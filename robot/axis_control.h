// SPDX-License-Identifier: Apache-2.0
// One axis: its drive, its state as PLCopen has it, and what it was asked to do by itself. While the group moves, the
// axis only follows.

#pragma once

#include "robot/arm.h"
#include "robot/axis_motion.h"
#include "robot/drive.h"
#include "robot/errors.h"

namespace indurop::robot {

class AxisControl {
 public:
  struct Scale {
    double counts = 1;  // per radian or metre
    double gear = 1;
    double unit = kPi / 180;  // what its users count in: degrees or millimetres
  };
  AxisControl() = default;
  void set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute) noexcept;

  // What the drive says, at the start of a period. Real-time safe, as all the rest.
  void sense(const DriveIn& in) noexcept;
  // A new request, if its number is another one. `group_moves`: the axis is not free.
  void serve(const AxisRequest& request, bool group_moves) noexcept;
  // Goes on with its own motion.
  void move(double seconds) noexcept;
  // Follows the group.
  void follow(const LineState& state) noexcept;
  // Is commanded to be here, whatever it was doing.
  void put(const LineState& state) noexcept { motion_.reset(state); }
  // The drive has not followed since the last period: the commanded position may be anywhere.
  [[nodiscard]] bool placed_anew() const noexcept { return placed_anew_; }
  // Stands still where it is commanded to be: the group's motion has ended.
  void rest() noexcept { motion_.reset({motion_.state().position, 0, 0}); }
  // What the drive is told.
  [[nodiscard]] DriveOut command(const DriveIn& in, bool quick_stop) noexcept;

  // Part of the speed of its own motions, from 0 (it holds) to 1.
  void set_override(double part) noexcept { motion_.set_override(part); }
  void power(bool on) noexcept { want_power_ = on; }
  // Homes on the group's behalf.
  void home() noexcept;
  // Comes to rest by itself and stays in ErrorStop until reset().
  void fail(ErrorCode code, double hardness) noexcept;
  void stop(double hardness) noexcept { motion_.stop(limits(hardness)); }
  // Leaves ErrorStop; a fault of the drive is acknowledged.
  void reset() noexcept;

  [[nodiscard]] const Drive& drive() const noexcept { return drive_; }
  [[nodiscard]] AxisState state() const noexcept { return state_; }
  [[nodiscard]] bool homed() const noexcept { return homed_; }
  [[nodiscard]] bool wants_power() const noexcept { return want_power_; }
  // In a motion of its own.
  [[nodiscard]] bool busy() const noexcept;
  [[nodiscard]] bool at_rest() const noexcept { return motion_.at_rest(); }
  [[nodiscard]] double unit() const noexcept { return scale_.unit; }
  [[nodiscard]] double measured() const noexcept { return measured_; }
  [[nodiscard]] const LineState& commanded() const noexcept { return motion_.state(); }
  [[nodiscard]] AxisReport report() const noexcept;

 private:
  void begin(const AxisRequest& request) noexcept;
  ErrorCode begin_motion(const AxisRequest& request, AxisService service) noexcept;
  ErrorCode begin_home() noexcept;
  void finish(ErrorCode code) noexcept;
  void move_home(double seconds) noexcept;
  void wait_for_power(double seconds) noexcept;
  void wait_for_reset(double seconds) noexcept;
  void guard_limits(double seconds) noexcept;
  [[nodiscard]] LineLimits limits(double hardness) const noexcept;

  double lower_ = 0, upper_ = 0;
  bool endless_ = false;
  LineLimits most_;
  Scale scale_;
  Drive drive_;
  AxisMotion motion_;
  AxisState state_ = AxisState::Disabled;
  double measured_ = 0;
  bool want_power_ = false;
  bool homed_ = true;
  bool placed_anew_ = true;
  bool first_ = true;    // before the first request was looked at
  bool active_ = false;  // a request is on its way
  double waited_ = 0;    // s, for power or home
  AxisService service_ = AxisService::None;
  AxisReport report_;
};

}  // namespace indurop::robot
