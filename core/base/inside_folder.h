// SPDX-License-Identifier: Apache-2.0
// Limits what another user's project may name to files in its own folder.

#pragma once

#include <filesystem>

namespace indurop::base {

// Returns whether the file is in the folder or below it, with all symbolic links followed.
[[nodiscard]] bool lies_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace indurop::base
