// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/port_watch.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {

constexpr Clock kPeriod = std::chrono::seconds(1);
constexpr std::size_t kBytes = 0x14;  // from kRxErrors to the last lost link
constexpr std::size_t kLostLinksAt = reg::kLostLinks - reg::kRxErrors;
constexpr std::uint8_t kHigh = 0x80;
constexpr std::array<std::uint8_t, kBytes> kNoErrors{};

}  // namespace

void PortWatch::begin(Clock now) noexcept {
  due_at_ = now;
  clears_ = false;
}

Query PortWatch::query(std::uint16_t station, Clock now) noexcept {
  const std::uint32_t address = address_of(station, reg::kRxErrors);
  is_clearing_ = clears_;
  clears_ = false;
  if (is_clearing_) {
    return {Command::Fpwr, address, kNoErrors, 0};
  }
  due_at_ = now + kPeriod;
  return {Command::Fprd, address, {}, kBytes};
}

std::optional<PortWatch::Finding> PortWatch::answer(Bytes data) noexcept {
  if (is_clearing_) {
    last_.fill(0);
    return std::nullopt;
  }
  std::array<std::uint8_t, kCounters> now{};
  std::copy_n(data.begin(), 2 * kPorts, now.begin());
  std::copy_n(data.begin() + kLostLinksAt, kPorts, now.begin() + 2 * kPorts);
  const auto before = knows_last_ ? last_ : now;
  const auto more = [&](std::size_t i) {
    return static_cast<std::uint16_t>(now[i] > before[i] ? now[i] - before[i] : 0);
  };
  std::optional<Finding> worst;
  for (std::uint8_t port = 0; port < kPorts; ++port) {
    // A frame that is physically broken counts as invalid as well.
    const std::size_t at = std::size_t{2} * port;
    const Finding found{port, std::max(more(at), more(at + 1)), more(2 * kPorts + port)};
    const auto size = [](const Finding& one) { return one.broken_frames + one.lost_links; };
    errors_ += static_cast<std::uint64_t>(size(found));
    if (size(found) > 0 && (!worst || size(found) > size(*worst))) {
      worst = found;
    }
  }
  last_ = now;
  knows_last_ = true;
  clears_ = std::any_of(now.begin(), now.end(), [](std::uint8_t counter) { return counter >= kHigh; });
  if (clears_) {
    due_at_ = Clock(0);
  }
  return worst;
}

}  // namespace indurop::io::ethercat
