// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/segment.h"

#include <utility>

namespace indurop::io::ethercat {

namespace {
constexpr std::size_t kSourceByte = 6;
constexpr std::uint8_t kLocallyGiven = 0x02;  // the first slave sets this bit of the source address
}  // namespace

Slave& Segment::add(SlaveConfig config, Slave::Application application) {
  slaves_.emplace_back(std::move(config), std::move(application));
  link();
  return slaves_.back();
}

void Segment::set_power(std::size_t index, bool on) {
  slaves_[index].set_power(on);
  link();
}

std::size_t Segment::reached() const noexcept {
  std::size_t count = 0;
  while (count < slaves_.size() && slaves_[count].is_on()) {
    ++count;
  }
  return count;
}

void Segment::link() noexcept {
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    slaves_[i].set_next_port(i + 1 < slaves_.size() && slaves_[i + 1].is_on());
  }
}

std::optional<Time> Segment::process(std::span<std::uint8_t> frame, Time now) {
  const std::size_t count = reached();
  if (count == 0 || FrameReader(frame).fault() != FrameFault::None) {
    return std::nullopt;
  }
  frame[kSourceByte] |= kLocallyGiven;
  for (std::size_t i = 0; i < count; ++i) {
    // From the last slave it goes the same way back: the next port is as many cables away, twice.
    const auto steps = static_cast<std::int64_t>(i + 1);
    const auto beyond = static_cast<std::int64_t>(count - 1 - i);
    slaves_[i].process(frame, now + steps * delay_, now + (steps + 2 * beyond) * delay_);
  }
  return now + static_cast<std::int64_t>(2 * count) * delay_;
}

void Segment::compute() {
  for (Slave& slave : slaves_) {
    if (slave.is_on()) {
      slave.compute();
    }
  }
}

void Segment::break_frame_at(std::size_t index) noexcept {
  auto& esc = slaves_[index].esc();
  const std::uint8_t errors = esc.at(reg::kRxErrors);
  esc.set<std::uint8_t>(reg::kRxErrors, errors == 0xFF ? errors : static_cast<std::uint8_t>(errors + 1));
}

}  // namespace indurop::io::ethercat
