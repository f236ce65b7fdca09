// SPDX-License-Identifier: Apache-2.0
// Finds the built examples of InduRoP.

#pragma once

#include <filesystem>
#include <string>

namespace indurop::tools {

// Returns the folder of the built example `name` with its demo.sh, in the build directory or installation of these
// programs. Empty: it does not exist.
std::filesystem::path example_folder(const std::filesystem::path& programs, const std::string& name);

}  // namespace indurop::tools
