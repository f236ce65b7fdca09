// SPDX-License-Identifier: Apache-2.0
#include "history/recording/crc32.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace indurop::recording {
namespace {

static_assert(std::endian::native == std::endian::little, "eight bytes are taken as one number");

constexpr std::size_t kStep = 8;
using Table = std::array<std::array<std::uint32_t, 256>, kStep>;

// kTables[n][b]: the effect of byte b on the result when n more bytes follow it.
constexpr Table make_tables() {
  Table tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) {
      crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    tables[0][byte] = crc;
  }
  for (std::size_t n = 1; n < kStep; ++n) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t crc = tables[n - 1][byte];
      tables[n][byte] = (crc >> 8U) ^ tables[0][crc & 0xFFU];
    }
  }
  return tables;
}

constexpr Table kTables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before) noexcept {
  std::uint32_t crc = ~before;
  while (bytes.size() >= kStep) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, bytes.data(), kStep);
    eight ^= crc;
    crc = 0;
    for (std::size_t n = 0; n < kStep; ++n) {
      crc ^= kTables[kStep - 1 - n][(eight >> (8 * n)) & 0xFFU];
    }
    bytes = bytes.subspan(kStep);
  }
  for (const std::uint8_t byte : bytes) {
    crc = (crc >> 8U) ^ kTables[0][(crc ^ byte) & 0xFFU];
  }
  return ~crc;
}

}  // namespace indurop::recording
