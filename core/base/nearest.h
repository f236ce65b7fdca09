// SPDX-License-Identifier: Apache-2.0
// "Did you mean": finds the known name closest to a mistyped one.

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace indurop::base {

// Returns the candidate with the fewest edits (insert, delete, replace, swap neighbours; case does not count) from
// `name`, the first of equals; empty if none is within a third of the name's length.
std::string nearest(std::string_view name, std::span<const std::string> candidates);

}  // namespace indurop::base
