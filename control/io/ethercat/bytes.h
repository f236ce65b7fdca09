// SPDX-License-Identifier: Apache-2.0
// Numbers in bytes, the low byte first, as everything after the Ethernet header of EtherCAT is. The caller has checked
// that the bytes are there.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

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
  const auto wide = static_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(wide >> (8U * i));
  }
}

}  // namespace indurop::io::ethercat
