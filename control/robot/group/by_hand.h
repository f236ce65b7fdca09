// SPDX-License-Identifier: Apache-2.0
// What moves the arm by hand: jogging, by the buttons of a pendant, and guiding, by a push.

#pragma once

#include "control/robot/group/guiding.h"
#include "control/robot/group/jogging.h"

namespace indurop::robot {

struct ByHand {
  Jogging jogging;
  Guiding guiding;
};

}  // namespace indurop::robot
