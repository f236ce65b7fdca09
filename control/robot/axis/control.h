// SPDX-License-Identifier: Apache-2.0
// One axis and its PLCopen state: it takes requests and commands as a single axis and hands them to those who carry
// them out, its motions, its power and its touch probe. While the group moves, the axis only follows.

#pragma once

#include "control/robot/axis/answers.h"
#include "control/robot/axis/body.h"
#include "control/robot/axis/command_table.h"
#include "control/robot/axis/motions.h"
#include "control/robot/axis/power.h"
#include "control/robot/axis/probing.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

class AxisControl : public AxisBody {
 public:
  using Row = AxisNeighbours;
  using Scale = AxisUnits::Scale;
  using Leader = AxisLeader;

  AxisControl() noexcept
      : answers_(parts().state), power_(parts(), answers_), motions_(parts(), answers_), probing_(answers_) {}
  AxisControl(const AxisControl&) = delete;
  AxisControl& operator=(const AxisControl&) = delete;

  void set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute, CommandTable* table,
              const Row& row) noexcept;

  // Takes the drive's status at the start of a period. Real-time safe, like all functions below.
  void sense(const DriveIn& in, double seconds) noexcept;
  // Takes a request if its number is new. `permit`: Ok, or the reason why the axis may not move as a single axis.
  void serve(const AxisRequest& request, ErrorCode permit) noexcept;
  // Takes a command from the table.
  void take(int ticket, ErrorCode permit) noexcept;
  // Pushes with a torque for the job, until halt(); it must not be in the group.
  void push(const Command& command) noexcept {
    answers_.forget_error();
    motions_.take(AxisOwner::kJob, command);
  }
  // Why its last motion of its own ended or was refused; Ok: it did not, or well.
  [[nodiscard]] ErrorCode error() const noexcept { return answers_.report().error; }
  // Continues its own motion by one period; called after move() of its master.
  void move(double seconds) noexcept;
  // Follows the group.
  void follow(const LineState& state) noexcept;
  // Returns the output for the drive.
  [[nodiscard]] DriveOut command(const DriveIn& in, bool quick_stop) noexcept;

  void power(bool on) noexcept { power_.want(on); }
  [[nodiscard]] bool wants_power() const noexcept { return power_.wanted(); }
  // The group switches power off. An axis keeps it while it moves as a single axis or a command holds its power.
  void give_up_power() noexcept { power_.give_up(); }
  // Returns whether the command that held power has lost its Execute.
  [[nodiscard]] bool power_falls() const noexcept { return power_.falls(); }
  // In an emergency no axis is reset; while the group stops because of an error, a reset waits.
  void set_stops(bool emergency, bool group_stops) noexcept { power_.set_stops(emergency, group_stops); }
  // Homes as part of the group.
  void home() noexcept { motions_.home(); }
  // Comes to rest on its own and stays in ErrorStop until reset().
  void fail(ErrorCode code, double hardness) noexcept;
  // Comes to rest on its own, whatever was requested.
  void halt() noexcept { motions_.halt(); }
  // Leaves ErrorStop; a fault of the drive is acknowledged.
  void reset() noexcept { power_.reset(); }

  [[nodiscard]] AxisReport report() const noexcept;

 private:
  void order(int ticket, const Command& command) noexcept;
  void administer(int ticket, const Command& command) noexcept;
  void set_position(int ticket, const Command& command) noexcept;
  void write_parameter(int ticket, const Command& command) noexcept;
  void stop_for_power() noexcept;
  void sense_without_power(const DriveIn& in) noexcept;

  AxisAnswers answers_;
  AxisPower power_;
  AxisMotions motions_;
  Probing probing_;
  bool first_ = true;  // before the first request was read
};

}  // namespace indurop::robot
