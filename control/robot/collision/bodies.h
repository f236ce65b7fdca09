// SPDX-License-Identifier: Apache-2.0
// The bodies of an arm, its tools and its surroundings as read from files: those that must not touch each other.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "control/robot/collision/solid.h"

namespace indurop::robot {

// A link with its solids, in the base's frame with all joints at zero.
struct LinkBody {
  std::string name;
  int joint = 0;  // number of moving joints of the chain before it
  std::vector<Solid> solids;
};

// A zone that the arm must stay out of (the base's frame with all joints at zero, in which it stands still), or a solid
// of a tool (frame of the arm's end).
struct NamedSolid {
  std::string name;
  Solid solid;
  int tool = -1;  // for a solid of a tool: the tool's number, from 1
};

struct Bodies {
  std::vector<LinkBody> links;
  std::vector<NamedSolid> zones, tools;
  // Names of links (or tools) that may touch.
  std::vector<std::pair<std::string, std::string>> ignored;
  double clearance = 0;  // m; anything nearer counts as touching
};

}  // namespace indurop::robot
