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
  is_cut_.push_back(false);
  link();
  return slaves_.back();
}

void Segment::set_power(std::size_t index, bool on) {
  slaves_[index].set_power(on);
  link();
}

void Segment::make_ring() {
  is_ring_ = true;
  link();
}

void Segment::set_cable(std::size_t before, bool whole) {
  is_cut_[before] = !whole;
  link();
}

bool Segment::is_linked(std::size_t before) const noexcept {
  const bool has_left = before == 0 || slaves_[before - 1].is_on();
  const bool has_right = before == slaves_.size() ? is_ring_ : slaves_[before].is_on();
  return has_left && has_right && !is_cut_[before];
}

void Segment::link() noexcept {
  for (std::size_t i = 0; i < slaves_.size(); ++i) {
    slaves_[i].set_ports(is_linked(i), is_linked(i + 1));
  }
}

// Through the slaves from `begin` to before `end`, from the left to the right.
Time Segment::pass_slaves(std::span<std::uint8_t> frame, Time now, std::size_t begin, std::size_t end,
                          bool turns_round) {
  frame[kSourceByte] |= kLocallyGiven;
  const auto count = static_cast<std::int64_t>(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    // If the last slave turns it round it goes the same way back: the next port is as many cables away, twice.
    const auto steps = static_cast<std::int64_t>(i - begin + 1);
    const std::int64_t beyond = turns_round ? count - steps : 0;
    slaves_[i].process(frame, now + steps * delay_, now + (steps + 2 * beyond) * delay_);
  }
  return now + (turns_round ? 2 * count : count + 1) * delay_;
}

std::optional<Segment::Passed> Segment::pass(std::span<std::uint8_t> frame, Time now, End from) {
  if (FrameReader(frame).fault() != FrameFault::None) {
    return std::nullopt;
  }
  const std::size_t count = slaves_.size();
  std::size_t first = 0;  // how many are reached from there
  while (first < count && is_linked(first)) {
    ++first;
  }
  const bool is_whole = first == count && is_linked(count);
  if (from == End::First) {
    return first == 0
               ? std::nullopt
               : std::optional(Passed{pass_slaves(frame, now, 0, first, !is_whole), is_whole ? End::Last : End::First});
  }
  if (is_whole) {
    return Passed{now + static_cast<std::int64_t>(count + 1) * delay_, End::First};  // no slave works on it
  }
  std::size_t last = count;  // the first one that is reached from there
  while (last > 0 && is_linked(last)) {
    --last;
  }
  // To the cut without work, and back.
  const Time turned = now + static_cast<std::int64_t>(count - last) * delay_;
  return last == count ? std::nullopt
                       : std::optional(Passed{pass_slaves(frame, turned, last, count, false), End::Last});
}

std::optional<Time> Segment::process(std::span<std::uint8_t> frame, Time now) {
  const auto passed = pass(frame, now, End::First);
  return passed && passed->at == End::First ? std::optional(passed->back) : std::nullopt;
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
