// SPDX-License-Identifier: Apache-2.0
// What the characters of a program may be part of, in ASCII whatever the locale.

#pragma once

namespace indurop::plc::st {

constexpr bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
// May begin a name.
constexpr bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
// May go on in a name.
constexpr bool is_word(char c) noexcept {
  return is_letter(c) || is_digit(c);
}

}  // namespace indurop::plc::st
