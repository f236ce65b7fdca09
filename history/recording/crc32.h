// SPDX-License-Identifier: Apache-2.0
// CRC-32 as in Ethernet and zip: reflected, polynomial 0x04C11DB7.

#pragma once

#include <cstdint>
#include <span>

namespace indurop::recording {

// Returns the CRC of `bytes` appended to the bytes that gave `before`.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t before = 0) noexcept;

}  // namespace indurop::recording
