// SPDX-License-Identifier: Apache-2.0
#include "mirror/mirror_block.h"

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

}  // namespace indurop::mirror
