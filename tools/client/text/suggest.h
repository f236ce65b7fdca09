// SPDX-License-Identifier: Apache-2.0
// "Did you mean ...": the known word nearest to a mistyped one, and the variables that a short name may mean.

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::tools {

// Returns " Did you mean 'x'?" or an empty text. The unique continuation of a shortened word ("stat") also counts as
// near.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

// Returns those of the full names that may be meant: `typed` has dots or lacks leading namespaces.
std::vector<std::string> variables_named(std::string_view typed, std::span<const std::string> names);
// Returns a message that asks for the namespace.
std::string which_variable(std::string_view typed, std::span<const std::string> meant);

}  // namespace indurop::tools
