// SPDX-License-Identifier: Apache-2.0
// What a project of somebody else may name: files of its own folder.

#pragma once

#include <filesystem>

namespace indurop::base {

// Whether the file lies in the folder or deeper, with all symbolic links followed.
[[nodiscard]] bool lies_inside(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace indurop::base
