// SPDX-License-Identifier: Apache-2.0
// One axis: its drive, its PLCopen state, and its own requests as a single axis. While the group moves, the axis only
// follows.

#pragma once

#include <span>

#include "control/robot/axis/command_table.h"
#include "control/robot/axis/coupling.h"
#include "control/robot/axis/drive.h"
#include "control/robot/axis/motion.h"
#include "control/robot/axis/probe.h"
#include "control/robot/axis/torque_control.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

class AxisControl {
 public:
  // All axes of the arm, and the gates after them.
  struct Row {
    std::span<const AxisControl> axes;
    std::span<const SetPointGate> gates;
    std::span<const Cam> cams;
    const ProfileTables* profiles = nullptr;
    int own = 0;  // index of this axis, from 0
  };
  struct Scale {
    double counts = 1;  // per radian or metre; negative: the drive turns the other way
    double gear = 1;
    double unit = kPi / 180;  // unit of its users: degrees or millimetres
    double zero = 0;          // radians or metres, position of the axis while the drive is at count 0
  };
  AxisControl() = default;
  void set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute, CommandTable* table,
              const Row& row) noexcept;
  // Permits pushing with up to `most`, in N m or N; 0: the torque unit of its drive is unknown (torque.cpp).
  void allow_torque(double most) noexcept { most_torque_ = most; }

  // Takes the drive's status at the start of a period. Real-time safe, like all functions below.
  void sense(const DriveIn& in, double seconds) noexcept;
  // Takes a request if its number is new. `permit`: Ok, or the reason why the axis may not move as a single axis.
  void serve(const AxisRequest& request, ErrorCode permit) noexcept;
  // Takes a command from the table (orders.cpp).
  void take(int ticket, ErrorCode permit) noexcept;
  // Continues its own motion by one period; called after move() of its master.
  void move(double seconds) noexcept;
  // Returns whether other axes may follow this one.
  [[nodiscard]] bool leads() const noexcept;
  // An axis that it follows as a single axis, from 0, and the factor on its motion.
  struct Leader {
    int axis = 0;
    double ratio = 1;
  };
  [[nodiscard]] std::span<const Leader> leaders() const noexcept { return {leaders_.data(), coupled_ ? leading_ : 0}; }
  // Follows the group.
  void follow(const LineState& state) noexcept;
  // Sets the commanded state, whatever the axis was doing.
  void put(const LineState& state) noexcept;
  // Returns whether its gate has to bring it to rest; the gate then reports its state to braked().
  [[nodiscard]] bool brakes() const noexcept { return leaving_ && coupling_.brakes(); }
  void braked(const LineState& state) noexcept { motion_.lend(state); }
  // Returns whether the drive has not followed since the last period: the commanded position may be anywhere.
  [[nodiscard]] bool placed_anew() const noexcept { return placed_anew_; }
  // Returns whether it pushes with a torque: the set point is the drive's position.
  [[nodiscard]] bool pushes() const noexcept { return push_.pushes(); }
  [[nodiscard]] bool led_by_drive() const noexcept { return led_by_drive_; }
  void carry(const TorqueControl::Load& load) noexcept { push_.carry(load); }
  // Returns the torque for its drive in addition to what the arm needs, in N m or N.
  [[nodiscard]] double torque() const noexcept { return push_.torque(); }
  // Rests at the commanded position: the group's motion has ended.
  void rest() noexcept { motion_.reset({motion_.state().position, 0, 0}); }
  // Returns the output for the drive.
  [[nodiscard]] DriveOut command(const DriveIn& in, bool quick_stop) noexcept;

  // Part of the speed of its own motions, from 0 (hold) to 1, and the factors on accelerations and jerks of motions
  // that begin.
  void set_override(double part) noexcept {
    override_ = part;
    motion_.set_override(part);
    coupling_.hold(!(part > 0));
  }
  void set_factors(double acceleration, double jerk) noexcept;
  void power(bool on) noexcept { want_power_ = on; }
  // The group switches power off. An axis keeps it while it moves as a single axis or a command holds its power
  // (power.cpp).
  void give_up_power() noexcept { want_power_ = want_power_ && (holds_power() || busy()); }
  // Returns whether the command that held power has lost its Execute.
  [[nodiscard]] bool power_falls() const noexcept { return power_ != kNobody && !holds_power(); }
  // In an emergency no axis is reset; while the group stops because of an error, a reset waits.
  void set_stops(bool emergency, bool group_stops) noexcept {
    emergency_ = emergency;
    group_stops_ = group_stops;
  }
  // Homes as part of the group.
  void home() noexcept;
  // Comes to rest on its own and stays in ErrorStop until reset().
  void fail(ErrorCode code, double hardness) noexcept;
  // Comes to rest on its own, whatever was requested.
  void halt() noexcept;
  // Leaves ErrorStop; a fault of the drive is acknowledged.
  void reset() noexcept;

  [[nodiscard]] const Drive& drive() const noexcept { return drive_; }
  [[nodiscard]] AxisState state() const noexcept { return state_; }
  [[nodiscard]] bool homed() const noexcept { return homed_; }
  [[nodiscard]] bool wants_power() const noexcept { return want_power_; }
  [[nodiscard]] bool in_group() const noexcept { return state_ == AxisState::SynchronizedMotion && !coupled_; }
  // Returns whether it is in a motion of its own.
  [[nodiscard]] bool busy() const noexcept;
  [[nodiscard]] bool at_rest() const noexcept { return !over_ && motion_.at_rest(); }
  [[nodiscard]] double unit() const noexcept { return scale_.unit; }
  // Return 1 or -1: the sign of the drive's torque relative to the axis, for measured and for commanded values.
  [[nodiscard]] double drive_way() const noexcept { return std::copysign(1, scale_.counts); }
  [[nodiscard]] double command_way() const noexcept { return std::copysign(1, scale_.counts * scale_.gear); }
  [[nodiscard]] double measured() const noexcept { return measured_; }
  [[nodiscard]] const LineState& commanded() const noexcept { return over_ ? coupling_.state() : motion_.state(); }
  [[nodiscard]] AxisReport report() const noexcept;

 private:
  // Who waits for the end of an action: a ticket of the table, or the request.
  static constexpr int kNobody = CommandTable::kNone;
  static constexpr int kRequest = -2;
  struct Owner {
    int ticket = kNobody;
    AxisService service = AxisService::None;
  };
  // A motion as requested, in radians or metres.
  struct Order {
    double target = 0;  // position or velocity
    double end = 0;     // velocity to continue with; for a torque, its rate of change
    LineLimits limits, braking;
  };
  static constexpr auto kServices = static_cast<std::size_t>(AxisService::TorqueControl) + 1;
  // A motion without a target rests at this distance from the ends of the axis.
  static constexpr double kEndMargin = radians(0.1);

  static AxisService service_of(const Command& command) noexcept;
  static bool is_move(AxisService service) noexcept;       // to a position
  static bool goes_on_from(AxisService service) noexcept;  // through a position
  static bool follows(AxisService service) noexcept;       // follows another axis
  static bool is_profile(AxisService service) noexcept;    // by a time table
  void order(int ticket, const Command& command) noexcept;
  void ignore(int ticket, const Command& command) noexcept;
  // Power and reset (power.cpp).
  void administer(int ticket, const Command& command) noexcept;
  void keep_power() noexcept;
  void interrupt_power() noexcept;
  void take_power(int ticket) noexcept;
  void give_power(int ticket) noexcept;
  [[nodiscard]] bool holds_power() const noexcept { return power_ != kNobody && table_->execute(power_); }
  void wait_for_power(double seconds) noexcept;
  void wait_for_reset(double seconds) noexcept;
  void stop_for(int ticket, const Command& command) noexcept;
  void set_position(int ticket, const Command& command) noexcept;
  void queue(int ticket, const Command& command) noexcept;
  // Parameters of the axis (parameters.cpp).
  // Limits of its own motions; the ends apply only if they are enabled.
  struct Own {
    double lower = 0, upper = 0;
    bool lower_counts = true, upper_counts = true;
    double velocity = 0, acceleration = 0, deceleration = 0, jerk = 0;
  };
  void write_parameter(int ticket, const Command& command) noexcept;
  ErrorCode change(int parameter, double value) noexcept;
  ErrorCode change_ends(const Own& own) noexcept;
  void keep_ends() noexcept;
  void report_own(AxisReport& report) const noexcept;
  [[nodiscard]] ErrorCode check(const Command& command) const noexcept;
  // Converts a command into a motion (resolve.cpp).
  [[nodiscard]] ErrorCode resolve(const Command& command, double from, Order& order) const noexcept;
  [[nodiscard]] ErrorCode check_way(const Command& command, const Order& order) const noexcept;
  [[nodiscard]] double turned(double target, double from, Direction direction) const noexcept;
  void begin(int ticket, const Command& command) noexcept;
  void begin_motion(const Command& command, const Order& order) noexcept;
  void begin_next() noexcept;
  void abort_queue() noexcept;
  void choose_passing() noexcept;  // blend.cpp
  void look_at_commands() noexcept;
  void release_stop() noexcept;
  void end_motion(ErrorCode code) noexcept;

  // Following another axis (couple.cpp).
  struct Coupled {
    CouplingLaw law;
    std::array<Leader, 2> leaders;
    std::size_t leading = 1;
  };
  [[nodiscard]] bool follows_itself(const Coupled& way) const noexcept;
  [[nodiscard]] ErrorCode resolve(const Command& command, const Order& order, Coupled& way) const noexcept;
  [[nodiscard]] ErrorCode resolve_ratios(const Command& command, Coupled& way) const noexcept;
  [[nodiscard]] ErrorCode resolve_meeting(const Command& command, const Order& order, Coupled& way) const noexcept;
  [[nodiscard]] ErrorCode resolve_cam(const Command& command, const AxisControl& master,
                                      CouplingLaw& law) const noexcept;
  [[nodiscard]] bool inside(double one, double other) const noexcept;
  void couple(const Command& command, const Order& order) noexcept;
  void decouple(int ticket, const Command& command) noexcept;
  void let_go() noexcept;
  void fail_coupling(ErrorCode code) noexcept;
  void advance(double seconds) noexcept;
  void advance_own(double seconds) noexcept;
  void advance_coupled(double seconds) noexcept;
  // Superimposed motions (superimpose.cpp).
  [[nodiscard]] ErrorCode check_superimposed(const Command& command) const noexcept;
  void superimpose(int ticket, const Command& command) noexcept;
  void halt_superimposed(int ticket, const Command& command) noexcept;
  void advance_over(double seconds) noexcept;
  void note_superimposed() noexcept;
  void shift_master(int ticket, const Command& command) noexcept;
  [[nodiscard]] ErrorCode check_shift(const Command& command) const noexcept;

  // Motion by a time table (along.cpp).
  ErrorCode read_table(const Command& command, TimeProfile& table) const noexcept;
  [[nodiscard]] ErrorCode check_profile(const Command& command) const noexcept;
  void begin_profile(const Command& command) noexcept;
  void guard_table() noexcept;

  // Motion by its drive's torque (torque.cpp).
  [[nodiscard]] ErrorCode resolve_torque(const Command& command, Order& order) const noexcept;
  void begin_torque(const Order& order) noexcept;
  void leave_torque() noexcept;
  void fail_torque(ErrorCode code) noexcept;
  void watch_mode(const DriveIn& in, double seconds) noexcept;
  bool prepare_torque(double seconds) noexcept;
  void advance_torque(double seconds) noexcept;
  bool too_fast(double seconds) noexcept;
  [[nodiscard]] bool rests_in_time(double ahead) const noexcept;

  // Its touch probe (probe.cpp).
  void begin_probe(int ticket, const Command& command) noexcept;
  void abort_probe(int ticket, const Command& command) noexcept;
  void sense_probe(const DriveIn& in) noexcept;

  void finish(Owner& owner, ErrorCode code) noexcept;
  void move_home(double seconds) noexcept;
  void guard_limits(double seconds) noexcept;
  void note_velocity() noexcept;
  [[nodiscard]] LineLimits limits(double hardness) const noexcept;

  Own own_;
  double least_ = 0, greatest_ = 0;  // ends of the axis
  double lower_ = 0, upper_ = 0;     // its own ends where they are enabled, else those of the axis
  bool endless_ = false;
  LineLimits most_;
  Scale scale_;
  Drive drive_;
  AxisMotion motion_;
  Row row_;
  AxisCoupling coupling_;
  bool coupled_ = false;
  bool over_ = false;     // the coupling is superimposed on its own motion
  bool leaving_ = false;  // the request begins once the axis has no acceleration
  std::array<Leader, 2> leaders_;
  std::size_t leading_ = 1;  // number of leaders
  TorqueControl push_;
  double most_torque_ = 0;
  double override_ = 1;
  bool led_by_drive_ = false;    // its set point is the drive's position
  bool in_torque_mode_ = false;  // whether the drive is
  double mode_waited_ = 0;       // s, for a change of its mode
  int mode_late_ = 0;            // periods, for a change of its mode
  double slowing_from_ = 0;      // rad/s or m/s: its speed when it got another velocity
  double slowing_ = 0;           // s since then
  int too_fast_ = 0;             // number of periods
  AxisState state_ = AxisState::Disabled;
  double measured_ = 0;
  double measured_speed_ = 0;
  bool sensed_ = false;
  bool want_power_ = false;
  bool letting_go_ = false;  // waits for the drive, still on from before PowerOn, to switch off
  bool homed_ = true;
  bool placed_anew_ = true;
  bool first_ = true;  // before the first request was read
  double waited_ = 0;  // s, for power or home
  double origin_ = 0;  // of the positions reported for single axes, from the drive's
  double acceleration_factor_ = 1, jerk_factor_ = 1;
  CommandTable* table_ = nullptr;
  Owner admin_;          // of power and reset
  int power_ = kNobody;  // the command that holds power as long as it has its Execute
  bool emergency_ = false;
  bool group_stops_ = false;
  bool quick_stopped_ = false;  // its drive is about to lose power, whatever its status
  Owner motion_owner_;          // of the motion in progress
  Owner super_;                 // of the superimposed motion
  Owner probing_;
  AxisProbe probe_;
  bool probe_windowed_ = false;
  double probe_first_ = 0, probe_last_ = 0;  // in units of its users
  int stop_ = kNobody;                       // the stop that holds the axis
  double began_at_ = 0;                      // where the motion in progress began
  double added_to_ = 0;                      // what MoveAdditive adds to
  std::array<int, CommandTable::kMost> queue_{};
  int queued_ = 0;
  AxisReport report_;
};

}  // namespace indurop::robot
