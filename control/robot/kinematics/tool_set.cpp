// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/tool_set.h"

#include <algorithm>
#include <iterator>

namespace indurop::robot {

ToolSet::ToolSet(const Arm& arm, const std::vector<Pose>& tools) {
  std::transform(tools.begin(), tools.end(), std::back_inserter(held_),
                 [&](const Pose& tool) { return std::make_unique<const Held>(arm.with_tool(tool)); });
}

}  // namespace indurop::robot
