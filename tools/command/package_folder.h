// SPDX-License-Identifier: Apache-2.0
// Where CMake finds InduRoP.

#pragma once

#include <filesystem>

namespace indurop::tools {

// Folder with InduRoPConfig.cmake that belongs to these programs: their build directory or their installation. Empty:
// it is not there.
std::filesystem::path package_folder(const std::filesystem::path& programs);

}  // namespace indurop::tools
