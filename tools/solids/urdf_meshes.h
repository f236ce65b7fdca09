// SPDX-License-Identifier: Apache-2.0
// Finds the collision meshes of the links in a URDF file, and writes the file with solids instead of them.

#pragma once

#include <string>
#include <vector>

#include "control/robot/collision/solid.h"
#include "core/base/diagnostic.h"

namespace indurop::solids {

// A <collision> element with a mesh.
struct CollisionMesh {
  std::string link;
  std::string uri;  // of the mesh, as the file names it
  base::SourcePlace place;
  std::size_t begin = 0, end = 0;  // bytes of the element in the text
  robot::Pose origin;              // in the frame of its link
  robot::Vec3 scale = robot::Vec3::Ones();
};

struct FoundMeshes {
  std::vector<CollisionMesh> meshes;       // in the order of the file
  std::vector<base::Diagnostic> mistakes;  // all errors in the text of `file`
};
FoundMeshes find_meshes(const std::string& file, const std::string& text);

// Returns the text in which the element of each mesh is replaced by its solids, given in the frame of its link. The
// rest is unchanged.
std::string with_solids(const std::string& text, const std::vector<CollisionMesh>& meshes,
                        const std::vector<std::vector<robot::Solid>>& solids);

}  // namespace indurop::solids
