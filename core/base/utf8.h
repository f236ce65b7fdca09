// SPDX-License-Identifier: Apache-2.0
// Text as characters of UTF-8 (RFC 3629: no overlong forms, no surrogates).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace indurop::base {

// Returns the length in bytes of the character at the start of `text`, which is not empty; 0 if it is not valid.
std::size_t utf8_length(std::string_view text) noexcept;

// Returns the offset of the first byte that is not UTF-8, if any.
std::optional<std::size_t> first_invalid_utf8(std::string_view text) noexcept;

// Appends a character, at most U+10FFFF and no surrogate.
void append_utf8(std::string& to, std::uint32_t code);

// Returns true for a byte that continues a character.
constexpr bool continues_utf8(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

}  // namespace indurop::base
