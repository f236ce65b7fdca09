// SPDX-License-Identifier: Apache-2.0
// Text for people: quoting, lists, suggestions, and counting characters of UTF-8.

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace indurop::base {

// Without the blanks, tabs and line ends around it.
std::string_view trimmed(std::string_view text) noexcept;

// Text as users wrote it, in quotes, shortened if long.
std::string in_quotes(std::string_view text);
// Of a path the end counts: shortened, if very long, at its beginning.
std::string path_in_quotes(std::string_view path);
// The known name somebody who wrote `name` may have meant: nearest by letters, or one that contains it; empty if none.
std::string meant(std::string_view name, const std::vector<std::string>& known);
// "; did you mean 'period'?" or, if nothing is near, "; known are: a, b, c".
std::string suggestion(std::string_view name, const std::vector<std::string>& known);
// "a", "a and b", "a, b and c"; beyond `most` "a, b, c and 4 more".
std::string enumerate(const std::vector<std::string>& names, std::size_t most = 6);

// What stands before each line end, and behind the last.
std::vector<std::string> lines_of(const std::string& text);

// Number of characters, not bytes.
std::size_t characters(std::string_view text) noexcept;
// At most `most` characters, the last an ellipsis if some were cut off.
std::string shortened(std::string_view text, std::size_t most);

}  // namespace indurop::base
