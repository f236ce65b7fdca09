// SPDX-License-Identifier: Apache-2.0
// Draws meshes with the solids around them, seen from three sides.

#pragma once

#include <string>
#include <vector>

#include "control/robot/collision/solid.h"
#include "tools/solids/mesh.h"

namespace indurop::solids {

struct DrawnMesh {
  std::string title;
  Surface surface;  // in the frame of its link
  std::vector<robot::Solid> solids;
};

// Returns an SVG document with one row for each mesh.
std::string draw(const std::vector<DrawnMesh>& meshes);

}  // namespace indurop::solids
