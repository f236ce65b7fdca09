// SPDX-License-Identifier: Apache-2.0
// All axes of the arm, or all single axes, with the gates after them, the cams and profiles that they follow, and the
// set points of the last period. Knows nothing of the group.

#pragma once

#include <array>
#include <span>

#include "control/robot/axis/command_table.h"
#include "control/robot/axis/control.h"
#include "control/robot/axis/set_point_gate.h"
#include "control/robot/group/parts.h"

namespace indurop::robot {

class AxisRow {
 public:
  // `parts`, `table` and `travel` must outlive it. With the way of the tool, which they may follow, it is the row of
  // the single axes; else that of the arm.
  AxisRow(const GroupParts& parts, CommandTable& table, const ToolTravel* travel = nullptr) noexcept;
  AxisRow(const AxisRow&) = delete;
  AxisRow& operator=(const AxisRow&) = delete;

  // All functions are real-time safe. An index counts from 0.
  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] AxisControl& operator[](int i) noexcept { return axes_[at(i)]; }
  [[nodiscard]] const AxisControl& operator[](int i) const noexcept { return axes_[at(i)]; }
  [[nodiscard]] AxisControl* begin() noexcept { return axes_.data(); }
  [[nodiscard]] AxisControl* end() noexcept { return axes_.data() + count_; }
  [[nodiscard]] const AxisControl* begin() const noexcept { return axes_.data(); }
  [[nodiscard]] const AxisControl* end() const noexcept { return axes_.data() + count_; }
  [[nodiscard]] SetPointGate& gate(int i) noexcept { return gates_[at(i)]; }
  [[nodiscard]] const SetPointGate& gate(int i) const noexcept { return gates_[at(i)]; }

  [[nodiscard]] Joints commanded() const noexcept;
  [[nodiscard]] Joints measured() const noexcept;
  // What the drives got last.
  [[nodiscard]] Joints passed() const noexcept;
  // Converts from the units of users: degrees or millimetres.
  [[nodiscard]] Joints from_users(const double* numbers) const noexcept;

  [[nodiscard]] bool any_busy() const noexcept;
  [[nodiscard]] bool any_enabled() const noexcept;
  [[nodiscard]] bool any_wants_power() const noexcept;
  [[nodiscard]] bool any_displaced() const noexcept;
  [[nodiscard]] bool any_pushes() const noexcept;
  [[nodiscard]] bool all_enabled() const noexcept;
  [[nodiscard]] bool all_homed() const noexcept;
  [[nodiscard]] bool all_failed() const noexcept;
  // Returns whether all commanded motions have ended; the same for the set points that the drives got.
  [[nodiscard]] bool at_rest() const noexcept;
  [[nodiscard]] bool gates_at_rest() const noexcept;

  // Moves each axis that is not moved by the group, after the one that it follows; there are no cycles.
  void move() noexcept;
  // Returns the first axis that is too far from its set point; -1: none.
  [[nodiscard]] int first_behind() const noexcept;
  // Stops axes that lag while they move as single axes without power of the group; the others continue.
  void fail_behind() noexcept;
  // The group's motion has ended: the axes that followed it rest.
  void end_group_motion() noexcept;
  void halt() noexcept;
  void power(bool on) noexcept;
  void give_up_power() noexcept;
  // Sets the motion to rest of each axis if all of them brake at once. Returns the longest duration.
  double stops(std::array<Profile, kAxes>& stops) const noexcept;

  // A follower that uses another cam of that number continues with the old one. Errors: Value.
  ErrorCode set_cam(int number, const CamTables& cams, bool periodic) noexcept;
  void set_profiles(const ProfileTables& profiles) noexcept { profiles_ = profiles; }

  // Commanded joints and their speed in the last period; a motion of the group continues from them.
  [[nodiscard]] const Joints& last() const noexcept { return last_; }
  [[nodiscard]] const Joints& last_speed() const noexcept { return last_speed_; }
  // A motion begins at the commanded position.
  void start_here() noexcept { last_ = commanded(); }
  void note(const Joints& speed) noexcept {
    last_speed_ = speed;
    start_here();
  }

 private:
  [[nodiscard]] bool is_behind(const AxisControl& a) const noexcept;

  std::array<AxisControl, kAxes> axes_;
  std::array<SetPointGate, kAxes> gates_;
  std::array<Cam, kCams> cams_;
  ProfileTables profiles_{};
  const JointLimits& limits_;
  double period_;  // s
  double following_limit_;
  int count_;
  Joints last_ = Joints::Zero();
  Joints last_speed_ = Joints::Zero();
};

}  // namespace indurop::robot
