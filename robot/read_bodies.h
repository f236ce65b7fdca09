// SPDX-License-Identifier: Apache-2.0
// All bodies of a cell out of its files, what must stay clear of what, and which points are too near to something.

#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "robot/clearance.h"
#include "robot/job.h"
#include "robot/urdf.h"

namespace indurop::robot {

struct ReadBodies {
  Clearance clearance;
  std::vector<base::Diagnostic> found;
};
// `ignored`: names of links, tools or zones that may touch, "forearm gripper, wrist table". `clearance`: mm. Tools and
// frames have found their places.
ReadBodies read_bodies(const ArmModel& model, const JobBook& book, const std::string& urdf, const std::string& ignored,
                       double clearance);

// What is too near to each other at many places of the axes, so that the robot would seldom move: warnings.
std::vector<base::Diagnostic> check_room(const Arm& arm, const Clearance& clearance, const std::string& urdf);

// Points at which the arm would touch something, however it is held there: warnings.
std::vector<base::Diagnostic> check_clear(const JobBook& book, const Arm& arm, const Clearance& clearance);

}  // namespace indurop::robot
