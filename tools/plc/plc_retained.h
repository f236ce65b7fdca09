// SPDX-License-Identifier: Apache-2.0
// What a new version of a PLC program means for the values that the last one retained.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace indurop::tools {

// Warnings: retained variables of the .glb file as it is, which `now`, that will replace it, has not or has with
// another type. `others` are the .glb files both use. None if there is no such file.
[[nodiscard]] std::vector<base::Diagnostic> retained_changes(const std::filesystem::path& glb, const std::string& now,
                                                             const std::vector<std::string>& others);

}  // namespace indurop::tools
