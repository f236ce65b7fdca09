// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/job_motions.h"

namespace indurop::robot {

// A hard stop keeps the limits of the joints, and not those of torques.
void JobMotions::halt() noexcept {
  if (robot_.tool.places().dynamics() == nullptr) {
    robot_.follower.stop_hard(1);
  } else {
    robot_.follower.stop();
  }
}

bool JobMotions::take_tool(int tool) noexcept {
  if (!settled() || plans_.holds_forgotten()) {
    return false;
  }
  if (tool != robot_.tool.number()) {
    robot_.tool.select(tool);
    torques_.reweigh();
  }
  return true;
}

bool JobMotions::take_load(int load) noexcept {
  if (!settled() || plans_.holds_forgotten()) {
    return false;
  }
  robot_.tool.select_load(load);
  torques_.reweigh();
  return true;
}

}  // namespace indurop::robot
