// SPDX-License-Identifier: Apache-2.0
// A bundle as a Debian package, which dpkg-deb writes: the same bytes for the same bundle and the same words.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"

namespace indurop::tools {

struct PlantPackage {
  std::string plant;
  std::string deployment;  // its id
  std::string comment;     // of the deployment; may be empty
  std::string version;     // of the package
  std::string maintainer;  // NAME <ADDRESS>
};

// Returns the name of the package: indurop-plant-cell. dpkg takes neither '_' nor capital letters: Cell_2 becomes
// indurop-plant-+cell.2, which no other plant has.
std::string package_name(const std::string& plant);
// Returns why this is not a version that apt can compare; empty if it is.
std::string version_problem(const std::string& version);
// Returns why this is not NAME <ADDRESS>; empty if it is.
std::string maintainer_problem(const std::string& maintainer);
// Returns where the package puts the bundle: usr/share/indurop/plants/cell.bundle, without the first slash.
std::filesystem::path installed_bundle(const std::string& plant);

// Writes the package `file` with the bundle that is installed_bundle() in the folder `tree`, to which its other files
// are added. `file` is complete or as it was before. Errors: dpkg-deb is missing or fails, files cannot be written.
Result<void, base::Problem> write_plant_package(const PlantPackage& package, const std::filesystem::path& tree,
                                                const std::filesystem::path& file);

}  // namespace indurop::tools
