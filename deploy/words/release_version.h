// SPDX-License-Identifier: Apache-2.0
// Versions of the platform: numbers with dots between them, and perhaps the name of a build: "0.3.0", "0.3.0+line2".

#pragma once

#include <string>
#include <string_view>

namespace indurop::deploy {

// Returns true for up to 60 letters, digits, '.', '+', '~' that begin with a digit.
bool is_release_version(std::string_view text) noexcept;

// Returns true if `a` comes before `b`, in the order of Debian's packages: 0.3~rc1 < 0.3 < 0.3.0 < 0.3.0+line2 < 0.10.
bool is_older_release(std::string_view a, std::string_view b) noexcept;

}  // namespace indurop::deploy
