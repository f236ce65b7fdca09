// SPDX-License-Identifier: Apache-2.0
// CRC-32C (Castagnoli), reflected, as in iSCSI and ext4: finds every error burst of up to 32 bits.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace indurop::vars {

namespace detail {
constexpr std::array<std::uint32_t, 256> make_crc32c_table() noexcept {
  constexpr std::uint32_t kPolynomial = 0x82F63B78;
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    std::uint32_t rest = i;
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest & 1U) != 0 ? (rest >> 1U) ^ kPolynomial : rest >> 1U;
    }
    table[i] = rest;
  }
  return table;
}
inline constexpr auto kCrc32cTable = make_crc32c_table();
}  // namespace detail

constexpr std::uint32_t crc32c(std::span<const std::uint8_t> bytes) noexcept {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::uint8_t byte : bytes) {
    crc = (crc >> 8U) ^ detail::kCrc32cTable[(crc ^ byte) & 0xFFU];
  }
  return ~crc;
}

}  // namespace indurop::vars
