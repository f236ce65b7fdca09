// SPDX-License-Identifier: Apache-2.0
// "Did you mean ...": the known word nearest to a mistyped one.

#pragma once

#include <span>
#include <string>
#include <string_view>

namespace indurop::tools {

// Returns " Did you mean 'x'?" or an empty text. The unique continuation of a shortened word ("stat") also counts as
// near.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace indurop::tools
