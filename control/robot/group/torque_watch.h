// SPDX-License-Identifier: Apache-2.0
// Torques of the group: what the arm needs, the feed-forward of the drives, and contact detection.

#pragma once

#include <array>
#include <cstdint>

#include "control/robot/axis/torque_feed.h"
#include "control/robot/group/contact_watch.h"
#include "control/robot/group/fault_text.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class TorqueWatch {
 public:
  TorqueWatch(Robot& robot, GroupPort& group) noexcept;

  // Whether a hand guides the arm: its push does not stop the robot, but is measured even without a collision limit.
  enum class Guided : std::uint8_t { No, Weighed, Moved };
  void guide(Guided guided) noexcept { guided_ = guided; }
  // Reads the torques that the drives measure, and stops the robot if something pushes against the arm. Real-time safe,
  // like all functions of this class.
  void step(const Inputs& in) noexcept;
  // Accepts a push that may last: only more than that counts from now on.
  void release() noexcept { contact_.release(); }
  // The arm holds something else.
  void reweigh() noexcept { feed_.reweigh(); }
  // What pushes from outside, N m (N): the drives hold against it in addition to what the arm needs; and their torques
  // as they report them. The first axis of the arm whose torque is not known; -1: none.
  [[nodiscard]] Joints push() const noexcept { return -contact_.residual(); }
  [[nodiscard]] const std::array<std::int16_t, kAxes>& raw() const noexcept { return raw_; }
  [[nodiscard]] int first_unknown() const noexcept;
  // Sets the inertia that each pushing axis moves, and the part of its effort that is left.
  void weigh_pushing() noexcept;
  // Feed-forward in 1/1000 of the rated torque, as the drive expects it (60B2h, 6071h).
  void feed(Outputs& out) noexcept;
  void report(Outputs& out) const noexcept;

 private:
  [[nodiscard]] double most_torque(int axis) const noexcept;
  [[nodiscard]] Joints needed() const noexcept;

  Robot& robot_;
  GroupPort& group_;
  Joints rated_;                           // torque of the drives; 0: unknown
  Joints torque_ = Joints::Zero();         // measured
  std::array<std::int16_t, kAxes> raw_{};  // the same in parts of the rated one
  Guided guided_ = Guided::No;
  TorqueFeed feed_;
  ContactWatch contact_;
  FaultText text_ = "";  // of the last contact
};

}  // namespace indurop::robot
