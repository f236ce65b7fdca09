// SPDX-License-Identifier: Apache-2.0
// The meshes that the links of a URDF file collide with, and the file with solids in their place.

#pragma once

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "robot/solid.h"

namespace indurop::solids {

// A <collision> that is made of a mesh.
struct CollisionMesh {
  std::string link;
  std::string uri;  // of the mesh, as the file names it
  base::SourcePlace place;
  std::size_t begin = 0, end = 0;  // bytes of the element in the text
  robot::Pose origin;              // in its link
  robot::Vec3 scale = robot::Vec3::Ones();
};

struct FoundMeshes {
  std::vector<CollisionMesh> meshes;       // in the order of the file
  std::vector<base::Diagnostic> mistakes;  // errors: all that is wrong with the text of `file`
};
FoundMeshes find_meshes(const std::string& file, const std::string& text);

// The text with the solids of each mesh, which are in its link, in place of its element. The rest stays as it was.
std::string with_solids(const std::string& text, const std::vector<CollisionMesh>& meshes,
                        const std::vector<std::vector<robot::Solid>>& solids);

}  // namespace indurop::solids
