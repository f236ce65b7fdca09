// SPDX-License-Identifier: Apache-2.0
// A running robot as its shared variables and its files show it.

#pragma once

#include <string>

#include "robot/teach.h"
#include "tools/command/failure.h"
#include "tools/command/robot_files.h"
#include "tools/values/variables.h"

namespace indurop::tools {

struct RobotChoice {
  std::string space = "PLC_ROBOT";  // the namespace of its variables
  std::string module;               // empty: the only one of the node
  std::string config;               // whose files are meant; empty: what the node runs
};

struct RobotPlace {
  robot::Stand stand;
  std::string tool;  // empty: none
  bool moves = false;
};
// The exit code, after an error message.
int read_place(Context& context, const vars::Store& store, const RobotChoice& choice, RobotPlace& to);

// The files that the node's robot reads. Failures: no node, no robot in it, several and none chosen, files of a
// deployment (`to_change`: they are copies, which the next one replaces).
Result<RobotFiles, Failure> files_of_node(const std::string& node, const RobotChoice& choice, bool to_change);

}  // namespace indurop::tools
