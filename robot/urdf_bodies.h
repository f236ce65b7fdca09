// SPDX-License-Identifier: Apache-2.0
// The masses of an arm out of its URDF: what each joint of the chain moves, branches and fixed links with it.

#pragma once

#include <urdf_model/model.h>

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "robot/dynamics.h"

namespace indurop::robot {

Pose pose_of(const urdf::Pose& pose) noexcept;

// A link between root and tool.
struct ChainLink {
  urdf::LinkConstSharedPtr link;
  Pose frame;     // with all joints at zero
  int body = -1;  // the number of the joint before it that moves; -1: none does
};

struct UrdfBodies {
  std::vector<Body> bodies;          // in the base's frame, one of each joint that moves
  std::vector<std::string> without;  // links behind such a joint, where nothing that it moves has a mass
  std::vector<base::Diagnostic> errors;
};

UrdfBodies bodies_of(const std::vector<ChainLink>& chain, std::size_t count, const std::string& file,
                     const std::string& text);

}  // namespace indurop::robot
