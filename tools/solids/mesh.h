// SPDX-License-Identifier: Apache-2.0
// Reads surfaces from the files that URDF's <mesh> names: STL, COLLADA, OBJ. With mesh.cpp the only place that uses
// assimp.

#pragma once

#include <indurop/result.h>

#include <array>
#include <filesystem>
#include <vector>

#include "control/robot/kinematics/geometry.h"
#include "core/base/problem.h"

namespace indurop::solids {

using robot::Vec3;

using Triangle = std::array<Vec3, 3>;  // m
using Surface = std::vector<Triangle>;

// `scale` is that of <mesh>; units that a COLLADA file declares are applied, its upward axis is not, as in other
// programs that read URDF. Errors: what is wrong with the file, one line without the file name.
Result<Surface, base::Problem> read_mesh(const std::filesystem::path& file, const Vec3& scale);

}  // namespace indurop::solids
