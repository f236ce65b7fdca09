// SPDX-License-Identifier: Apache-2.0
#include "scheduler/change_proposal.h"

namespace indurop::scheduler {

void ChangeProposal::propose(const Time& time) noexcept {
  time_ = time;
  word_.store(proposed(time.tick), std::memory_order_seq_cst);
}

bool ChangeProposal::confirm() noexcept {
  std::uint64_t word = proposed(time_.tick);
  return word_.compare_exchange_strong(word, confirmed(time_.tick), std::memory_order_seq_cst);
}

std::optional<std::uint64_t> ChangeProposal::due(std::uint64_t tick) noexcept {
  std::uint64_t word = word_.load(std::memory_order_seq_cst);
  if (word == 0 || tick < (word >> 1) - 1) {
    return std::nullopt;
  }
  const bool refused = (word & 1) == 0 && word_.compare_exchange_strong(word, 0, std::memory_order_seq_cst);
  // If it was confirmed or taken back at this moment, `word` has that.
  return refused || (word & 1) == 0 ? std::nullopt : std::optional((word >> 1) - 1);
}

void ChangeProposal::postpone(std::uint64_t tick) noexcept {
  const std::uint64_t later = time_.tick + ((tick - time_.tick) / time_.step + 1) * time_.step;
  word_.store(later <= time_.last ? confirmed(later) : 0, std::memory_order_release);
}

}  // namespace indurop::scheduler
