// SPDX-License-Identifier: Apache-2.0
// Bytes as text.

#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace indurop::base {

// Two lower-case digits for each byte.
inline std::string in_hexadecimal(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  text.reserve(2 * bytes.size());
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 0xFU];
  }
  return text;
}

}  // namespace indurop::base
