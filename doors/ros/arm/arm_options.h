// SPDX-License-Identifier: Apache-2.0
// The options of both programs of ROS: the node, and the arm in it.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "doors/ros/model/joints.h"

namespace indurop::ros {

struct ArmOptions {
  std::string node;  // of InduRoP; empty: the usual one
  double rate_hz = 50;
  std::filesystem::path urdf;  // empty: no arm
  std::string robot = "PLC_ROBOT";
  std::string controller = "arm_controller";
  bool move = false;
  bool quiet = false;
};
// `published`: what --rate is for. `anyone`: whom --move lets move the arm.
void declare_arm_options(base::Options& app, ArmOptions& options, const std::string& published,
                         const std::string& anyone);

// Returns what is wrong with a name of ROS, such as "arm_controller" or "/cell/left"; empty: nothing.
std::string ros_name_problem(const std::string& name);

struct ArmFile {
  std::string text;  // of the URDF file
  std::vector<Joint> joints;
};
// Both empty without --urdf. Errors: all that is wrong, for stderr.
Result<ArmFile, std::string> read_arm(const ArmOptions& options, const std::string& program);

}  // namespace indurop::ros
