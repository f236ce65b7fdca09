// SPDX-License-Identifier: Apache-2.0
// What the jobs and properties of a robot module say of the space around it, for programs that show robots without
// reading their files.

#pragma once

#include <string>
#include <vector>

#include "config/model/config.h"
#include "control/robot/files/list_bodies.h"
#include "tools/client/robot/pallets.h"

namespace indurop::tools {

struct RobotScene {
  robot::ListedBodies bodies;
  std::vector<double> workspace;  // mm, two opposite corners in the frame of the base; empty: there is none
  std::vector<Pallet> pallets{};
  std::string problem{};  // why something of it is missing; empty: nothing is
};
// Empty if the files cannot be read.
RobotScene robot_scene_of(const config::Config& config, const std::string& module);

}  // namespace indurop::tools
