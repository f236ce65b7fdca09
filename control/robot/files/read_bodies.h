// SPDX-License-Identifier: Apache-2.0
// All bodies of a cell from its files, the pairs that must stay clear of each other, and the points that are too close
// to something.

#pragma once

#include <string>
#include <vector>

#include "control/robot/collision/clearance.h"
#include "control/robot/files/urdf.h"
#include "control/robot/job/job.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

struct ReadBodies {
  Clearance clearance;
  std::vector<base::Diagnostic> found;
};
// Reads the bodies. `ignored`: names of links, tools or zones that may touch, such as "forearm gripper, wrist table".
// `clearance`: mm. Tools and frames have been placed before.
ReadBodies read_bodies(const ArmModel& model, const JobBook& book, const std::string& urdf, const std::string& ignored,
                       double clearance);

// Warns about bodies that are too close to each other at many positions of the axes, so that the robot could seldom
// move.
std::vector<base::Diagnostic> check_room(const Arm& arm, const Clearance& clearance, const std::string& urdf);

// Warns about points at which the arm would touch something in every posture.
std::vector<base::Diagnostic> check_clear(const JobBook& book, const Arm& arm, const Clearance& clearance);

}  // namespace indurop::robot
