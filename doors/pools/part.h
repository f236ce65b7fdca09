// SPDX-License-Identifier: Apache-2.0
// A part of a chunk as it travels between boards (idl/pool.idl), without DDS.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace indurop::pool_door {

// Part::data of all parts but the last one of a chunk; PART_BYTES of idl/pool.idl.
inline constexpr std::uint64_t kPartBytes = 262'144;

struct Part {
  std::uint64_t session = 0;
  std::uint64_t number = 0;
  std::int64_t published_ns = 0;  // CLOCK_REALTIME of the sending board
  std::uint64_t size = 0;         // of the whole chunk
  std::uint64_t offset = 0;
  std::span<const std::byte> data;
};

constexpr std::uint64_t parts_of(std::uint64_t size) noexcept {
  return (size + kPartBytes - 1) / kPartBytes;
}
// The bytes of the part at `offset`, which is below `size`.
constexpr std::uint64_t part_bytes(std::uint64_t size, std::uint64_t offset) noexcept {
  return size - offset < kPartBytes ? size - offset : kPartBytes;
}
// Returns false if the part cannot be one of a chunk of `size` bytes.
constexpr bool is_part_of(const Part& part, std::uint64_t size) noexcept {
  return part.number != 0 && part.size == size && part.offset < size && part.offset % kPartBytes == 0 &&
         part.data.size() == part_bytes(size, part.offset);
}

}  // namespace indurop::pool_door
