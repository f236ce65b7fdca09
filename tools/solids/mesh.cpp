// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/mesh.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <system_error>

namespace indurop::solids {

Result<Surface, base::Problem> read_mesh(const std::filesystem::path& file, const Vec3& scale) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) {
    return base::Problem{"it is not an ordinary file"};
  }
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // Points and lines do not belong to a surface.
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    return base::Problem{importer.GetErrorString()};
  }
  Surface surface;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) {
        continue;
      }
      Triangle triangle;
      for (unsigned i = 0; i < 3; ++i) {
        const aiVector3D& point = mesh.mVertices[face.mIndices[i]];
        triangle[i] = Vec3(point.x, point.y, point.z).cwiseProduct(scale);
        if (!triangle[i].allFinite()) {
          return base::Problem{"it has a point that is no number"};
        }
      }
      surface.push_back(triangle);
    }
  }
  if (surface.empty()) {
    return base::Problem{"it has no surface"};
  }
  return surface;
}

}  // namespace indurop::solids
