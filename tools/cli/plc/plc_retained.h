// SPDX-License-Identifier: Apache-2.0
// Compares a new version of a PLC program with the values that the last one retained.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::tools {

// Returns warnings: retained variables of the existing .glb file that `now`, the text that will replace it, does not
// have or has with another type. `others` are the .glb files that both use. None if there is no such file.
[[nodiscard]] std::vector<base::Diagnostic> retained_changes(const std::filesystem::path& glb, const std::string& now,
                                                             const std::vector<std::string>& others);

}  // namespace indurop::tools
