// SPDX-License-Identifier: Apache-2.0
// Torques of the group: what the arm needs, the feed-forward of the drives, and contact detection.

#pragma once

#include "control/robot/axis/torque_feed.h"
#include "control/robot/group/contact_watch.h"
#include "control/robot/group/fault_text.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class TorqueWatch {
 public:
  TorqueWatch(Robot& robot, GroupPort& group) noexcept;

  // Reads the torques that the drives measure, and stops the robot if something pushes against the arm. Real-time safe,
  // like all functions of this class.
  void step(const Inputs& in) noexcept;
  // Accepts a push that may last: only more than that counts from now on.
  void release() noexcept { contact_.release(); }
  // The arm holds something else.
  void reweigh() noexcept { feed_.reweigh(); }
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
  Joints rated_;                    // torque of the drives; 0: unknown
  Joints torque_ = Joints::Zero();  // measured
  TorqueFeed feed_;
  ContactWatch contact_;
  FaultText text_ = "";  // of the last contact
};

}  // namespace indurop::robot
