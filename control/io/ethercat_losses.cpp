// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat_losses.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace indurop::io {

namespace {

constexpr std::chrono::seconds kEvery{10};

}  // namespace

void EthercatLosses::set(const ethercat::BusCounters& counters) noexcept {
  all_ = counters;
  missed_.store(counters.lost + counters.not_sent, std::memory_order_relaxed);
}

std::string EthercatLosses::news(ethercat::Clock now) {
  const std::uint64_t missed = missed_.load(std::memory_order_relaxed);
  if (missed == reported_ || (reported_ != 0 && now - reported_at_ < kEvery)) {
    return {};
  }
  const std::uint64_t count = missed - std::exchange(reported_, missed);
  reported_at_ = now;
  return fmt::format("{} frame{} late or lost", count, count == 1 ? "" : "s");
}

// A frame that came back late has reached the slaves; one that was lost need not have.
std::string EthercatLosses::total() const {
  return fmt::format(
      "{} frames sent: {} came back late, {} were lost, {} doubled, {} not ours, {} not taken by the "
      "interface",
      all_.sent, all_.late, all_.lost - std::min(all_.late, all_.lost), all_.duplicates, all_.foreign, all_.not_sent);
}

}  // namespace indurop::io
