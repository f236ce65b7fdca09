// SPDX-License-Identifier: Apache-2.0
// Finds the file of URDF's <mesh filename="...">.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <map>
#include <string>

#include "core/base/problem.h"

namespace indurop::solids {

// Folders of packages, by name of the package.
using Packages = std::map<std::string, std::filesystem::path>;

// `package://NAME/...` (also model://) is searched for in `packages`, else in the parent folders of `urdf` that are
// called NAME or contain a folder NAME; any other path is relative to the folder of `urdf`. Errors: the paths that were
// tried.
Result<std::filesystem::path, base::Problem> mesh_file(const std::string& uri, const std::filesystem::path& urdf,
                                                       const Packages& packages);

}  // namespace indurop::solids
