// SPDX-License-Identifier: Apache-2.0
// What an arm, its tools and its surroundings are made of, as it was read: the bodies that must not touch each other.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "robot/solid.h"

namespace indurop::robot {

// A link with its solids, in the base's frame with all joints at zero.
struct LinkBody {
  std::string name;
  int joint = 0;  // so many moving joints of the chain are before it
  std::vector<Solid> solids;
};

// What keeps the arm out (base frame), or belongs to a tool (frame of the arm's end).
struct NamedSolid {
  std::string name;
  Solid solid;
  int tool = -1;  // of a tool: its number, from 1
};

struct Bodies {
  std::vector<LinkBody> links;
  std::vector<NamedSolid> zones, tools;
  // Names of links (or tools) that may touch.
  std::vector<std::pair<std::string, std::string>> ignored;
  double clearance = 0;  // m, nearer than that is touching
};

}  // namespace indurop::robot
