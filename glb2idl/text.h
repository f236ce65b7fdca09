// SPDX-License-Identifier: Apache-2.0
// Small text functions: escapes of C, spelling suggestions, joining.

#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace indurop::glb2idl {

// Returns the content of "..." or '...', or nullopt if an escape is unknown.
[[nodiscard]] std::optional<std::string> decode_quoted(std::string_view quoted);

// Escapes a text for a C++ literal; bytes outside of printable ASCII become three octal digits.
[[nodiscard]] std::string escape(std::string_view text);

[[nodiscard]] std::string lower(std::string_view text);

[[nodiscard]] std::string join_names(std::span<const std::string> parts, std::string_view between);

// Makes a text safe for a one-line comment: no line breaks, no backslash at the end.
[[nodiscard]] std::string comment_line(std::string_view text);

}  // namespace indurop::glb2idl
