// SPDX-License-Identifier: Apache-2.0
// Version of the program, from the one place it is written: project() in the top CMakeLists.txt.

#pragma once

namespace indurop::tools {
inline constexpr const char* kVersionText = INDUROP_VERSION;
}  // namespace indurop::tools
