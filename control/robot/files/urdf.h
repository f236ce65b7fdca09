// SPDX-License-Identifier: Apache-2.0
// Reads an arm from a URDF file. Done once, when the task is loaded; with urdf_bodies.h and urdf_shapes.h the only file
// that knows urdfdom.

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "control/robot/collision/bodies.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/dynamics.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

struct ArmModel {
  Arm arm;
  Joints velocity;                        // rad/s or m/s, maximum of each axis
  Dynamics dynamics{};                    // known() if all links have their masses
  std::vector<LinkBody> bodies{};         // of <collision>
  std::vector<std::string> links{};       // names of all links
  std::vector<base::Diagnostic> notes{};  // including warnings
  std::vector<Axis> singles{};            // axes that belong to no group
  Joints single_velocity = Joints::Ones();
};

// Reads the moving joints between the root link and the tool: the link called tool0 or tcp if there is one, else the
// end of the chain. Joints that mimic one of them form a linkage. <workpiece link="..."/> names the link to which the
// workpiece is fixed: the joints between the root and this link are axes, too, after those of the arm, and the base's
// frame is that of this link. <single_axes joints="..."/> names joints that are axes, but belong to no group. Errors:
// everything that is wrong in the text of `file`.
Result<ArmModel, std::vector<base::Diagnostic>> arm_from_urdf(const std::string& file, const std::string& text);

}  // namespace indurop::robot
