// SPDX-License-Identifier: Apache-2.0
// UTF-8 to UTF-16 and back, for STRING and WSTRING. A byte that is not valid UTF-8 is taken as the character with its
// number, an unpaired UTF-16 surrogate as a character of its own, so that nothing is lost. Real-time safe.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace indurop::iec::detail {

struct CodePoint {
  std::uint32_t number = 0;
  std::size_t bytes = 1;  // its length in the text
};

// Decodes the first code point of a text that is not empty.
constexpr CodePoint first_point(std::string_view utf8) noexcept {
  const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(utf8[i])}; };
  const std::uint32_t lead = byte(0);
  std::size_t bytes = 1;
  if (lead >= 0xF0 && lead < 0xF8) {
    bytes = 4;
  } else if (lead >= 0xE0 && lead < 0xF0) {
    bytes = 3;
  } else if (lead >= 0xC2 && lead < 0xE0) {
    bytes = 2;
  }
  if (bytes == 1 || bytes > utf8.size()) {
    return {lead, 1};
  }
  constexpr std::uint32_t kLeadBits[] = {0, 0, 0x1F, 0x0F, 0x07};
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  constexpr std::uint32_t kMaxCodePoint = 0x10FFFF;
  std::uint32_t number = lead & kLeadBits[bytes];
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) {
      return {lead, 1};
    }
    number = number << 6U | (byte(i) & 0x3FU);
  }
  return number >= kLeast[bytes] && number <= kMaxCodePoint ? CodePoint{number, bytes} : CodePoint{lead, 1};
}

// Calls put(char16_t) for each character.
template <class Put>
constexpr void each_wide(std::string_view utf8, Put put) {
  while (!utf8.empty()) {
    const CodePoint point = first_point(utf8);
    utf8.remove_prefix(point.bytes);
    constexpr std::uint32_t kTwo = 0x10000;
    if (point.number < kTwo) {
      put(static_cast<char16_t>(point.number));
    } else {
      put(static_cast<char16_t>(0xD800U + ((point.number - kTwo) >> 10U)));
      put(static_cast<char16_t>(0xDC00U + ((point.number - kTwo) & 0x3FFU)));
    }
  }
}

// Calls put(char) for each byte of the text in UTF-8. An unpaired surrogate is encoded as if it were a character.
template <class Put>
constexpr void each_byte(std::u16string_view wide, Put put) {
  const auto tail = [&](std::uint32_t bits) { put(static_cast<char>(0x80U | (bits & 0x3FU))); };
  for (std::size_t i = 0; i < wide.size(); ++i) {
    std::uint32_t number = wide[i];
    const bool pair = (number & 0xFC00U) == 0xD800U && i + 1 < wide.size() && (wide[i + 1] & 0xFC00U) == 0xDC00U;
    if (pair) {
      number = 0x10000U + ((number & 0x3FFU) << 10U) + (wide[++i] & 0x3FFU);
      put(static_cast<char>(0xF0U | number >> 18U));
      tail(number >> 12U);
      tail(number >> 6U);
    } else if (number >= 0x800) {
      put(static_cast<char>(0xE0U | number >> 12U));
      tail(number >> 6U);
    } else if (number >= 0x80) {
      put(static_cast<char>(0xC0U | number >> 6U));
    } else {
      put(static_cast<char>(number));
      continue;
    }
    tail(number);
  }
}

// Returns the first UTF-16 unit of a text that is not empty.
constexpr char16_t first_wide(std::string_view utf8) noexcept {
  char16_t first = 0;
  each_wide(utf8.substr(0, first_point(utf8).bytes), [&](char16_t one) { first = first == 0 ? one : first; });
  return first;
}

}  // namespace indurop::iec::detail
