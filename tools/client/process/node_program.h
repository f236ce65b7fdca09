// SPDX-License-Identifier: Apache-2.0
// The program indurop-node, which other programs start.

#pragma once

#include <filesystem>

namespace indurop::tools {

inline constexpr const char* kNodeProgram = "indurop-node";

// Searches in the folder of this program, in ../libexec/indurop, then in PATH. Returns an empty path if it is not
// found.
std::filesystem::path find_node_program();

}  // namespace indurop::tools
