// SPDX-License-Identifier: Apache-2.0
// A line of a source text with a mark below, as messages show it.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace indurop::base {

// The line and, below it, a caret under character `column`, from 1, with `width` characters underlined. Of long lines
// the part around it; what a terminal might misread is shown as '?'.
[[nodiscard]] std::string picture_of_line(std::string_view line, std::size_t column, std::size_t width);

}  // namespace indurop::base
