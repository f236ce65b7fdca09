// SPDX-License-Identifier: Apache-2.0
// A variable that several boards have (<standby>): whether this board's value is the one that counts. The board that
// has served longest leads, as readers in the plant decide (landing.h), so each can tell by itself.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mirror/frames/mirror_block.h"

namespace indurop::mirror {

class Lead {
 public:
  // A board that has just joined the plant has heard by then who is there.
  static constexpr std::int64_t kPatienceNs = 1'000'000'000;

  // `plant` is borrowed. Without rivals this board leads always.
  Lead(const MirrorBlock* plant, const std::vector<std::string>& rivals);
  [[nodiscard]] bool ours() const noexcept { return ours_; }
  // True if that has changed.
  bool look(std::int64_t now_ns) noexcept;

 private:
  [[nodiscard]] bool longest() const noexcept;

  const MirrorBlock* plant_;
  std::vector<const PeerRecord*> rivals_;
  std::int64_t joined_ns_ = 0;  // 0: not in the network
  bool ours_;
};

}  // namespace indurop::mirror
