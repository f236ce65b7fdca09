// SPDX-License-Identifier: Apache-2.0
// The arm of examples/robot_cell with its limits, and others, for the tests.

#pragma once

#include <indurop/robot/controller.h>

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "control/robot/files/urdf.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/path/segment.h"
#include "control/robot/plan/planner.h"

namespace indurop::robot {

// Without what its links are made of, so that they can be anywhere.
std::string cell_urdf();
std::string solid_cell_urdf();
Arm cell_arm();
// Wrist axes that do not meet: no closed form.
Arm odd_arm();
// The text of a file in tests/unit/control/robot/arms, and its arm; throws what is wrong with it.
std::string urdf_of(const std::string& name);
Arm arm_of(const std::string& name);
JointLimits cell_limits();
// Names and texts of jobs in addition to the first one, which is "main".
using JobTexts = std::vector<std::pair<std::string, std::string>>;
// One that has read the texts as files. Throws what it says of them.
std::unique_ptr<Controller> controller_of(const std::string& urdf, const std::string& job, Settings settings = {},
                                          const JobTexts& others = {});

// Somewhere within the limits, `margin` away from them. The same sequence for the same seed.
Joints anywhere(const Arm& arm, std::mt19937& random, double margin = 0.01);
// A pose of the arm with each joint at most `far` (rad) from `q`.
Target pose_near(const Arm& arm, Joints q, double far, std::mt19937& random);
// The number in this environment variable, if it is set.
int number_of(const char* name, int otherwise);
// How many poses of each arm: INDUROP_ROBOT_POSES, if that is set.
int poses(int usual);
double distance(const Pose& a, const Pose& b);

}  // namespace indurop::robot
