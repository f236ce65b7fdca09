// SPDX-License-Identifier: Apache-2.0
// Shows a line of a source text with a mark below it in messages.

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace indurop::base {

// Returns the line and, below it, a caret under character `column`, from 1, with `width` characters underlined. Of long
// lines only the part around it is shown; characters that a terminal might misread are shown as '?'.
[[nodiscard]] std::string picture_of_line(std::string_view line, std::size_t column, std::size_t width);

}  // namespace indurop::base
