// SPDX-License-Identifier: Apache-2.0
// Reads the masses of an arm from its URDF: what each joint of the chain moves, including branches and fixed links.

#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

#include "control/robot/kinematics/dynamics.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

Pose pose_of(const urdf::Pose& pose) noexcept;

// A link between root and tool.
struct ChainLink {
  urdf::LinkConstSharedPtr link;
  Pose frame;     // with all joints at zero
  int body = -1;  // number of the moving joint before it; -1: none
};

struct UrdfBodies {
  std::vector<Body> bodies;          // in the base's frame, one per moving joint
  std::vector<std::string> without;  // links after such a joint if nothing that it moves has a mass
  std::vector<base::Diagnostic> errors;
};

UrdfBodies bodies_of(const std::vector<ChainLink>& chain, std::size_t count, const std::string& file,
                     const std::string& text);

}  // namespace indurop::robot
