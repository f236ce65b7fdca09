// SPDX-License-Identifier: Apache-2.0
// The robot that all classes of the group work on: what was loaded, its axes, what it holds, its path, its job and the
// state of the group. Each of them has its own contract; here they only stand together.

#pragma once

#include <chrono>
#include <utility>

#include "control/robot/axis/command_table.h"
#include "control/robot/group/axis_row.h"
#include "control/robot/group/held_tool.h"
#include "control/robot/group/parts.h"
#include "control/robot/group/single_axes.h"
#include "control/robot/group/states.h"
#include "control/robot/group/travel.h"
#include "control/robot/job/runner.h"
#include "control/robot/path/follower.h"

namespace indurop::robot {

struct Robot {
  explicit Robot(GroupParts given)
      : parts(std::move(given)),
        period(std::chrono::duration<double>(parts.settings.period).count()),
        tool(parts),
        axes(parts, table),
        singles(parts, table, &travel.seen()),
        follower(tool.places(), parts.joints),
        job(parts.book, parts.settings.first_question) {}
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  // Number of axes of the arm; the single ones come after them.
  [[nodiscard]] int count() const noexcept { return parts.arm.count(); }
  [[nodiscard]] Joints commanded() const noexcept { return axes.commanded(); }
  // The tool's pose at these joint positions.
  [[nodiscard]] Pose tip(const Joints& q) const noexcept { return tool.arm().forward(q); }
  // The path ends here; a motion of the group may begin.
  void stand_here() noexcept {
    follower.reset(commanded());
    axes.start_here();
  }

  GroupParts parts;
  double period;  // s
  CommandTable table;
  HeldTool tool;
  AxisRow axes;
  Travel travel;
  AxisRow singles;
  SingleAxes single{*this};  // what moves them
  GroupStates states;
  Follower follower;
  JobRunner job;
};

}  // namespace indurop::robot
