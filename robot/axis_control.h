// SPDX-License-Identifier: Apache-2.0
// One axis: its drive, its state as PLCopen has it, and what it was asked to do by itself. While the group moves, the
// axis only follows.

#pragma once

#include "robot/arm.h"
#include "robot/axis_motion.h"
#include "robot/command_table.h"
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
  void set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute,
              CommandTable* table) noexcept;

  // What the drive says, at the start of a period. Real-time safe, as all the rest.
  void sense(const DriveIn& in, double seconds) noexcept;
  // A new request, if its number is another one. `group_moves`: the axis is not free.
  void serve(const AxisRequest& request, bool group_moves) noexcept;
  // A command from the table (axis_orders.cpp).
  void take(int ticket, bool group_moves) noexcept;
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

  // Part of the speed of its own motions, from 0 (it holds) to 1; of the accelerations and jerks of those that begin.
  void set_override(double part) noexcept { motion_.set_override(part); }
  void set_factors(double acceleration, double jerk) noexcept;
  void power(bool on) noexcept { want_power_ = on; }
  // Homes on the group's behalf.
  void home() noexcept;
  // Comes to rest by itself and stays in ErrorStop until reset().
  void fail(ErrorCode code, double hardness) noexcept;
  void stop(double hardness) noexcept { motion_.stop(limits(hardness)); }
  // Comes to rest by itself, whatever it was asked for.
  void halt() noexcept;
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
  // Who waits for the end of something: a place in the table, or the request.
  static constexpr int kNobody = CommandTable::kNone;
  static constexpr int kRequest = -2;
  struct Owner {
    int ticket = kNobody;
    AxisService service = AxisService::None;
  };
  // A motion as it was asked for, in radians or metres.
  struct Order {
    double target = 0;  // position or velocity
    LineLimits limits, braking;
  };

  void order(int ticket, const Command& command) noexcept;
  void administer(int ticket, AxisService service) noexcept;
  void stop_for(int ticket, const Command& command) noexcept;
  void set_position(int ticket, const Command& command) noexcept;
  void queue(int ticket, const Command& command) noexcept;
  [[nodiscard]] ErrorCode check(const Command& command) const noexcept;
  [[nodiscard]] ErrorCode resolve(const Command& command, double from, Order& order) const noexcept;
  [[nodiscard]] double turned(double target, double from, Direction direction) const noexcept;
  void begin(int ticket, const Command& command) noexcept;
  void begin_motion(AxisService service, const Order& order) noexcept;
  void begin_next() noexcept;
  void abort_queue() noexcept;
  void choose_passing() noexcept;
  void look_at_commands() noexcept;
  void release_stop() noexcept;
  void end_motion(ErrorCode code) noexcept;

  void finish(Owner& owner, ErrorCode code) noexcept;
  void move_home(double seconds) noexcept;
  void wait_for_power(double seconds) noexcept;
  void wait_for_reset(double seconds) noexcept;
  void guard_limits(double seconds) noexcept;
  void note_velocity() noexcept;
  [[nodiscard]] LineLimits limits(double hardness) const noexcept;

  double lower_ = 0, upper_ = 0;
  bool endless_ = false;
  LineLimits most_;
  Scale scale_;
  Drive drive_;
  AxisMotion motion_;
  AxisState state_ = AxisState::Disabled;
  double measured_ = 0;
  double measured_speed_ = 0;
  bool sensed_ = false;
  bool want_power_ = false;
  bool homed_ = true;
  bool placed_anew_ = true;
  bool first_ = true;  // before the first request was looked at
  double waited_ = 0;  // s, for power or home
  double origin_ = 0;  // of the positions that single axes are told, from the drive's
  double acceleration_factor_ = 1, jerk_factor_ = 1;
  CommandTable* table_ = nullptr;
  Owner admin_;          // of power and reset
  Owner motion_owner_;   // of the motion on its way
  int stop_ = kNobody;   // the stop that holds the axis
  double began_at_ = 0;  // where the motion on its way began
  double added_to_ = 0;  // what MoveAdditive adds to
  std::array<int, CommandTable::kMost> queue_{};
  int queued_ = 0;
  AxisReport report_;
};

}  // namespace indurop::robot
