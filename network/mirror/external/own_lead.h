// SPDX-License-Identifier: Apache-2.0
// Decides whether this board's value of a variable that several boards have (<standby>) is the one that third-party
// programs see.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "network/mirror/frames/mirror_block.h"

namespace indurop::mirror {

class Lead {
 public:
  // By this time a board that has just joined the plant has discovered the others.
  static constexpr std::int64_t kPatienceNs = 1'000'000'000;

  // `plant` is borrowed. Without rivals this board always leads.
  Lead(const MirrorBlock* plant, const std::vector<std::string>& rivals);
  [[nodiscard]] bool ours() const noexcept { return ours_; }
  // Checks again who leads. Returns true if that has changed.
  bool update(std::int64_t now_ns) noexcept;

 private:
  [[nodiscard]] bool longest() const noexcept;

  const MirrorBlock* plant_;
  std::vector<const PeerRecord*> rivals_;
  std::int64_t joined_ns_ = 0;  // 0: not in the network
  bool ours_;
};

}  // namespace indurop::mirror
