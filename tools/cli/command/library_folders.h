// SPDX-License-Identifier: Apache-2.0
// Folders of libraries below a prefix, which distributions name differently.

#pragma once

#include <filesystem>
#include <vector>

namespace indurop::tools {

// Returns PREFIX/lib, PREFIX/lib64 and their folders (lib/x86_64-linux-gnu), whether or not these exist.
std::vector<std::filesystem::path> library_folders(const std::filesystem::path& prefix);

}  // namespace indurop::tools
