// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/external/own_lead.h"

#include <algorithm>
#include <utility>

#include "network/mirror/frames/leading_board.h"

namespace indurop::mirror {

Lead::Lead(const MirrorBlock* plant, const std::vector<std::string>& rivals) : plant_(plant) {
  for (std::uint32_t i = 0; plant != nullptr && i < plant->peer_count; ++i) {
    if (std::find(rivals.begin(), rivals.end(), plant->peers()[i].name) != rivals.end()) {
      rivals_.push_back(&plant->peers()[i]);
    }
  }
  ours_ = rivals_.empty();
}

bool Lead::longest() const noexcept {
  const std::uint64_t own = plant_->session.load(std::memory_order_relaxed);
  return std::none_of(rivals_.begin(), rivals_.end(), [own](const PeerRecord* rival) {
    return rival->state.load(std::memory_order_acquire) == PeerState::Alive &&
           leads(rival->session.load(std::memory_order_relaxed), own);
  });
}

bool Lead::update(std::int64_t now_ns) noexcept {
  if (rivals_.empty()) {
    return false;
  }
  if (joined_ns_ == 0 && plant_->network.load(std::memory_order_acquire) == Network::Up) {
    joined_ns_ = now_ns;
  }
  const bool ours = joined_ns_ != 0 && now_ns - joined_ns_ >= kPatienceNs && longest();
  return std::exchange(ours_, ours) != ours;
}

}  // namespace indurop::mirror
