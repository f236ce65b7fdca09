// SPDX-License-Identifier: Apache-2.0
// The word AXIS of a point or a motion: "AXIS 7 90" says where an axis stands that a pose leaves undetermined.

#pragma once

#include "control/robot/job/job.h"
#include "control/robot/job/line.h"

namespace indurop::robot {

// Parses the number after the word AXIS. Returns the axis, from 0; -1: it is wrong or among `given`, which earlier
// words of the line say, and the line has an error.
int axis_number(JobLine& line, const ArmShape& shape, Held given);

}  // namespace indurop::robot
