// SPDX-License-Identifier: Apache-2.0
// What the group reports of its motion in every period: joints, and the tool with its speed and acceleration.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/range_report.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class MotionReport {
 public:
  MotionReport(Robot& robot, const ConveyorTracking& conveyor) noexcept
      : robot_(robot), conveyor_(conveyor), ranges_(robot) {}

  // `commanded`: the set points are those of motions; otherwise they only follow the positions that the drives report.
  // Real-time safe.
  void report(bool commanded, Outputs& out) noexcept;

 private:
  void report_axes(Outputs& out) const noexcept;
  void report_tool(const Twist& moved, Outputs& out) noexcept;

  Robot& robot_;
  const ConveyorTracking& conveyor_;
  RangeReport ranges_;
  Pose last_;                         // of the tool
  Twist last_moved_ = Twist::Zero();  // its speed
  unsigned tool_changes_ = 0;
};

}  // namespace indurop::robot
