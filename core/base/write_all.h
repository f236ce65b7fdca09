// SPDX-License-Identifier: Apache-2.0
// Writes all bytes to an open file, although the system may take them in parts.

#pragma once

#include <string_view>

namespace indurop::base {

// Returns 0, or an errno; then some of the bytes may have been written.
int write_all(int file, std::string_view bytes) noexcept;

}  // namespace indurop::base
