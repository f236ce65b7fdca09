// SPDX-License-Identifier: Apache-2.0
// Where the file is that URDF's <mesh filename="..."> means.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <map>
#include <string>

#include "base/problem.h"

namespace indurop::solids {

// Folders of packages by name.
using Packages = std::map<std::string, std::filesystem::path>;

// `package://NAME/...` (also model://) is looked for in `packages`, else in the folders around `urdf` that are called
// NAME or have a folder NAME in them; another path begins in the folder of `urdf`. Errors: what was looked for.
Result<std::filesystem::path, base::Problem> mesh_file(const std::string& uri, const std::filesystem::path& urdf,
                                                       const Packages& packages);

}  // namespace indurop::solids
