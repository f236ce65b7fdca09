// SPDX-License-Identifier: Apache-2.0
// Text for users: quoting, lists, suggestions, and counting characters of UTF-8.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::base {

// Returns the text without the blanks, tabs and line ends around it.
std::string_view trimmed(std::string_view text) noexcept;

// Returns text as users wrote it, in quotes, shortened if long.
std::string in_quotes(std::string_view text);
// The end of a path matters most: a very long one is shortened at its beginning.
std::string path_in_quotes(std::string_view path);
// Returns the known name that a user who wrote `name` may have meant: the nearest by letters, or one that contains it;
// empty if none.
std::string closest_name(std::string_view name, const std::vector<std::string>& known);
// Returns "; did you mean 'period'?" or, if no name is near, "; known are: a, b, c".
std::string suggestion(std::string_view name, const std::vector<std::string>& known);
// Returns "a", "a and b", "a, b and c"; with more than `most` names "a, b, c and 4 more".
std::string enumerate(const std::vector<std::string>& names, std::size_t most = 6);

// Splits text at its line ends; the part after the last one is a line, too.
std::vector<std::string> lines_of(const std::string& text);

// Removes the first line from the text and returns it without its end.
std::string_view take_line(std::string_view& text) noexcept;
// Returns nothing if the text is more or less than the digits of a number of 64 bits.
std::optional<std::uint64_t> whole_number(std::string_view text) noexcept;

// Returns the number of characters, not bytes.
std::size_t characters(std::string_view text) noexcept;
// Returns at most `most` characters, the last an ellipsis if some were cut off.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace indurop::base
