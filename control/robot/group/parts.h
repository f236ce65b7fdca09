// SPDX-License-Identifier: Apache-2.0
// Everything that was read when the robot task was loaded.

#pragma once

#include <indurop/robot/controller.h>

#include <cstdint>
#include <string>
#include <vector>

#include "control/robot/collision/clearance.h"
#include "control/robot/job/job.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/dynamics.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

struct GroupParts {
  Settings settings;
  Arm arm;
  JointLimits joints;
  ToolLimits tool;
  JobBook book;
  std::string kind;
  Dynamics dynamics{};
  Clearance clearance;
  std::string urdf{};      // the text of its file
  std::uint64_t mark = 0;  // as ReadFiles::mark
  // The axes that belong to no group; their numbers are after those of the arm.
  std::vector<Axis> singles{};
  JointLimits single_limits{};
};

}  // namespace indurop::robot
