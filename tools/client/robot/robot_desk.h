// SPDX-License-Identifier: Apache-2.0
// A running robot, from its shared variables and its files.

#pragma once

#include <string>

#include "control/robot/files/stand.h"
#include "core/base/problem.h"
#include "store/vars/store.h"
#include "tools/client/failure.h"
#include "tools/client/robot/robot_files.h"

namespace indurop::tools {

struct RobotChoice {
  std::string space = "PLC_ROBOT";  // the namespace of its variables
  std::string module;               // empty: the only one of the node
  std::string config;               // configuration with the robot's files; empty: the one that the node runs
};

struct RobotPlace {
  robot::Stand stand;
  std::string tool;  // empty: none
  bool moves = false;
};
// Reads the current place of the robot with these variables.
Result<RobotPlace, base::Problem> read_place(const vars::Store& store, const std::string& space);

// Returns the files that the node's robot reads. Failures: no node, no robot in it, several and none chosen, files of a
// deployment (`to_change`: they are copies, which the next deployment replaces).
Result<RobotFiles, Failure> files_of_node(const std::string& node, const RobotChoice& choice, bool to_change);
// The same without a node, from the configuration that is chosen; for a plant, of all boards.
Result<RobotFiles, Failure> files_of_config(const RobotChoice& choice);

}  // namespace indurop::tools
