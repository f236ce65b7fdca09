// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/mirror_block.h"

namespace indurop::mirror {

const char* to_text(PeerState state) noexcept {
  switch (state) {
    case PeerState::Absent:
      return "absent";
    case PeerState::Alive:
      return "alive";
    case PeerState::Mismatched:
      return "mismatched";
    case PeerState::Silent:
      return "silent";
  }
  return "unknown";
}

const MirrorBlock* mirror_block_in(std::span<const std::byte> memory) noexcept {
  if (memory.size() < sizeof(MirrorBlock)) {
    return nullptr;
  }
  const auto* block = reinterpret_cast<const MirrorBlock*>(memory.data());
  const bool sound = block->magic.load(std::memory_order_acquire) == kMirrorMagic && block->abi == kMirrorAbi &&
                     memory.size() >= mirror_block_size(block->peer_count, block->incoming);
  return sound ? block : nullptr;
}

}  // namespace indurop::mirror
