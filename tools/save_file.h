// SPDX-License-Identifier: Apache-2.0
// Writes a result to a file of the user's choice.

#pragma once

#include <string>
#include <string_view>

namespace indurop::tools {

// Replaces the file. Returns what went wrong, or nothing.
std::string save_file(const std::string& path, std::string_view content);

}  // namespace indurop::tools
