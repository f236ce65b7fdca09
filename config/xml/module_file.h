// SPDX-License-Identifier: Apache-2.0
// The file that a <filename> means.

#pragma once

#include <filesystem>
#include <string>

namespace indurop::config {

// `text` is a path from `folder` on. A bare name that is no file there is looked for with what its ending and beginning
// may be, first there, then among the modules of this installation: NAME, NAME.so, libNAME.so, NAME.exe. The plain path
// if nothing is found.
std::filesystem::path module_file(const std::filesystem::path& folder, const std::string& text);

}  // namespace indurop::config
