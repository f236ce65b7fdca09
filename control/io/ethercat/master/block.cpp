// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/block.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

// Returns where the block is in a PDO whose first bit is this one.
std::optional<BlockPlace> place_in(const Pdo& pdo, const Block& block, std::size_t bit) noexcept {
  if (pdo.index == block.index) {
    return BlockPlace{bit, bits_of(pdo), 0};
  }
  std::optional<BlockPlace> found;
  for (const PdoEntry& entry : pdo.entries) {
    if (!found && is_object(entry, block.index, block.subindex)) {
      found = BlockPlace{bit, 0, entry.type};
    }
    bit += entry.bits;
    if (found && (block.last_index == 0 || is_object(entry, block.last_index, block.last_subindex))) {
      found->bits = bit - found->bit;
      return found;
    }
  }
  return std::nullopt;
}

}  // namespace

const Pdo* pdo_with(const std::vector<Pdo>& pdos, const Block& block) noexcept {
  for (const bool assigned : {true, false}) {
    const auto found = std::find_if(pdos.begin(), pdos.end(), [&block, assigned](const Pdo& pdo) {
      return (pdo.sync_manager != kNotAssigned) == assigned && place_in(pdo, block, 0);
    });
    if (found != pdos.end()) {
      return &*found;
    }
  }
  return nullptr;
}

std::optional<BlockPlace> find_block(const std::vector<Pdo>& pdos, const Block& block) noexcept {
  // The bytes of SyncManagers follow each other in their order, and in each of them its PDOs.
  std::size_t start = 0;
  for (std::uint8_t manager = 0; manager < kNotAssigned; ++manager) {
    std::size_t bit = start;
    for (const Pdo& pdo : pdos) {
      if (pdo.sync_manager != manager) {
        continue;
      }
      if (const auto found = place_in(pdo, block, bit)) {
        return found;
      }
      bit += bits_of(pdo);
    }
    start = (bit + 7) / 8 * 8;
  }
  return std::nullopt;
}

}  // namespace indurop::io::ethercat
