// SPDX-License-Identifier: Apache-2.0
// Types of kept variables as compilers write them: an array that has more elements in another version of its module.

#pragma once

#include <string_view>

namespace indurop::tape {

// Returns true if both are arrays of one dimension and of the same element, and `now` has more elements at its end:
// "double [4]" and "double [8]", "ARRAY[1..4] OF INT" and "ARRAY[1..8] OF INT".
bool has_grown(std::string_view before, std::string_view now) noexcept;

}  // namespace indurop::tape
