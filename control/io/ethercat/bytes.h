// SPDX-License-Identifier: Apache-2.0
// Numbers in bytes, the low byte first, as everything after the Ethernet header of EtherCAT is. The caller has checked
// that the bytes are there.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace indurop::io::ethercat {

using Bytes = std::span<const std::uint8_t>;

template <class T>
constexpr T load(Bytes bytes, std::size_t at) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    value |= std::uint64_t{bytes[at + i]} << (8U * i);
  }
  return static_cast<T>(value);
}

template <class T>
constexpr void store(std::span<std::uint8_t> bytes, std::size_t at, T value) noexcept {
  const auto wide = std::uint64_t{static_cast<std::make_unsigned_t<T>>(value)};
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(wide >> (8U * i));
  }
}

// Bits count from the lowest one of the first byte.
inline void copy_bits(Bytes from, std::uint64_t from_bit, std::span<std::uint8_t> to, std::uint64_t to_bit,
                      std::uint64_t count) noexcept {
  const std::uint64_t whole = from_bit % 8 == 0 && to_bit % 8 == 0 ? count / 8 : 0;
  for (std::uint64_t byte = 0; byte < whole; ++byte) {
    to[to_bit / 8 + byte] = from[from_bit / 8 + byte];
  }
  for (std::uint64_t bit = 8 * whole; bit < count; ++bit) {
    const unsigned value = static_cast<unsigned>(from[(from_bit + bit) / 8]) >> ((from_bit + bit) % 8) & 1U;
    const unsigned shift = (to_bit + bit) % 8;
    std::uint8_t& byte = to[(to_bit + bit) / 8];
    byte = static_cast<std::uint8_t>((byte & ~(1U << shift)) | value << shift);
  }
}

}  // namespace indurop::io::ethercat
