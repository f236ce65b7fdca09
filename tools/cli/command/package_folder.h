// SPDX-License-Identifier: Apache-2.0
// Finds the CMake package of InduRoP.

#pragma once

#include <filesystem>

namespace indurop::tools {

// Returns the folder with the InduRoPConfig.cmake of these programs: their build directory or their installation.
// Empty: it does not exist.
std::filesystem::path package_folder(const std::filesystem::path& programs);

}  // namespace indurop::tools
