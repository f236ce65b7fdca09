// SPDX-License-Identifier: Apache-2.0
#include "store/vars/previous_block.h"

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "store/vars/growth.h"
#include "store/vars/scalar.h"
#include "store/vars/tear_free_ring.h"

namespace indurop::vars {

Result<PreviousBlock> PreviousBlock::find(const std::string& node) {
  PreviousBlock previous;
  auto file = ShmFile::open(block_file(node), Mode::ReadWrite, kGrowthRoom);
  if (!file) {
    const Errc code = file.error().code;
    if (code == Errc::NotFound || code == Errc::Corrupt) {
      return previous;
    }
    return file.error();
  }
  if (auto index = check_block({file->data(), file->size()}); index && file->trusted()) {
    previous.index = std::move(index.value());
  }
  previous.file = std::move(file.value());
  return previous;
}

void PreviousBlock::retire() const noexcept {
  header_of(file->data())->state.store(BlockState::Retired, std::memory_order_release);
}

void PreviousBlock::carry_over(const BlockPlan& plan, std::byte* memory) const {
  std::vector<std::uint8_t> value;
  for (const DirectoryEntry& to : plan.directory) {
    const DirectoryEntry* from = index->find(to.name_hash);
    if (from == nullptr || from->type_hash != to.type_hash || from->kind != to.kind ||
        from->value_size != to.value_size) {
      continue;
    }
    std::byte* const old_entry = file->data() + from->offset;
    value.resize(to.value_size);
    if (to.kind == abi::Kind::Scalar) {
      read_scalar(old_entry, to.value_size, 0, value);
      write_scalar(memory + to.offset, to.value_size, 0, value);
    } else if (try_read(*reinterpret_cast<abi::RingHeader*>(old_entry), to.value_size, 0, value.data(),
                        to.value_size)) {
      auto& ring = *reinterpret_cast<abi::RingHeader*>(memory + to.offset);
      if (void* slot = begin_write(ring, 0, to.value_size); slot != nullptr) {
        std::memcpy(slot, value.data(), value.size());
        commit(ring);
      }
    }
  }
}

void PreviousBlock::own_everything() const noexcept {
  for (const DirectoryEntry& entry : index->directory) {
    std::byte* const at = file->data() + entry.offset;
    abi::confirmed_of(at, entry.kind).store(0, std::memory_order_release);
    abi::update_offset_of(at, entry.kind).store(0, std::memory_order_release);
    moved_of(at, entry.kind).store(0, std::memory_order_release);  // if it was killed while the type changed
  }
}

}  // namespace indurop::vars
