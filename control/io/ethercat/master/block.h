// SPDX-License-Identifier: Apache-2.0
// A part of a slave's process data, by the names of what is in it: one object, all that one PDO has from an object to
// another one, or a whole PDO. Not real-time safe.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

struct Block {
  std::uint16_t index = 0;  // of the first object, or of a PDO
  std::uint8_t subindex = 0;
  std::uint16_t last_index = 0;  // 0: it is one object, or a whole PDO
  std::uint8_t last_subindex = 0;
};

struct BlockPlace {
  std::size_t bit = 0;  // the first one, in the bytes of its direction
  std::size_t bits = 0;
  std::uint8_t type = 0;  // of the first object, as CoE numbers its data types
};
constexpr bool overlap(const BlockPlace& a, const BlockPlace& b) noexcept {
  return a.bit < b.bit + b.bits && b.bit < a.bit + a.bits;
}

// Returns the first PDO that has the block, of those that are assigned before the others; null if none has it.
const Pdo* pdo_with(const std::vector<Pdo>& pdos, const Block& block) noexcept;
// Returns where the block is in the PDOs that are assigned; nothing if none of them has it.
std::optional<BlockPlace> find_block(const std::vector<Pdo>& pdos, const Block& block) noexcept;

}  // namespace indurop::io::ethercat
