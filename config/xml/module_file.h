// SPDX-License-Identifier: Apache-2.0
// Finds the file that a <filename> refers to.

#pragma once

#include <filesystem>
#include <string>

namespace indurop::config {

// `text` is a path relative to `folder`. A bare name for which no file exists is searched for with the usual prefix and
// extensions, first in `folder`, then among the modules of this installation: NAME, NAME.so, libNAME.so, NAME.exe.
// Returns the plain path if nothing is found.
std::filesystem::path module_file(const std::filesystem::path& folder, const std::string& text);

}  // namespace indurop::config
