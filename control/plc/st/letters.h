// SPDX-License-Identifier: Apache-2.0
// Character classes of program text, in ASCII whatever the locale.

#pragma once

namespace indurop::plc::st {

constexpr bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
// Returns whether the character may begin a name.
constexpr bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
// Returns whether the character may continue a name.
constexpr bool is_word(char c) noexcept {
  return is_letter(c) || is_digit(c);
}

}  // namespace indurop::plc::st
