// SPDX-License-Identifier: Apache-2.0
#include "core/base/utf8.h"

#include <algorithm>
#include <array>

namespace indurop::base {
namespace {

// Returns the length of the code point that begins with this byte; 0 if none does.
std::size_t length_after(unsigned char first) noexcept {
  if (first < 0x80) {
    return 1;
  }
  if (first < 0xC2 || first >= 0xF5) {
    return 0;
  }
  if (first < 0xE0) {
    return 2;
  }
  return first < 0xF0 ? 3 : 4;
}

}  // namespace

std::size_t utf8_length(std::string_view text) noexcept {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t length = length_after(first);
  if (length == 0 || length > text.size()) {
    return 0;
  }
  const std::string_view others = text.substr(1, length - 1);
  if (!std::all_of(others.begin(), others.end(), continues_utf8)) {
    return 0;
  }
  const auto second = length > 1 ? static_cast<unsigned char>(text[1]) : 0;
  const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool beyond = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  return overlong || beyond ? 0 : length;
}

std::optional<std::size_t> first_invalid_utf8(std::string_view text) noexcept {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) {
      return at;
    }
    at += length;
  }
  return std::nullopt;
}

void append_utf8(std::string& to, std::uint32_t code) {
  if (code < 0x80) {
    to += static_cast<char>(code);
    return;
  }
  const unsigned others = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr std::array<std::uint32_t, 4> kMarks{0, 0xC0, 0xE0, 0xF0};  // of a first byte, by the number of others
  to += static_cast<char>(kMarks[others] | (code >> (6 * others)));
  for (unsigned left = others; left-- > 0;) {
    to += static_cast<char>(0x80U | ((code >> (6 * left)) & 0x3FU));
  }
}

}  // namespace indurop::base
