// SPDX-License-Identifier: Apache-2.0
// Breaks the lines of a help text that are too long for a terminal.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace indurop::base {

inline constexpr std::size_t kHelpWidth = 99;        // columns of the longest line
inline constexpr std::size_t kHelpDescription = 30;  // column in which the description of an option begins

// Descriptions of options continue below their begin. A paragraph with a line that is too long is filled again; it ends
// with an empty line, before a line that begins with a space, and after a heading (a line that ends with ':' before
// such a line). Words longer than a line, and lines in paragraphs that are short enough, stay.
[[nodiscard]] std::string wrapped_help(std::string_view text);

}  // namespace indurop::base
