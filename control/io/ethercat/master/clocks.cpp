// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/clocks.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace indurop::io::ethercat {

namespace {

using std::chrono::milliseconds;

constexpr Clock kQuiet = milliseconds(20);  // without a slave that comes or goes, then clocks are measured
constexpr Clock kMaxJump = std::chrono::microseconds(100);  // of the reference against the tick's clock
constexpr std::size_t kTimesBytes = 0x20;  // receive times of the ports, system time, receive time of the unit
constexpr std::uint16_t kUnitTimeAt = reg::kReceiveTimeUnit - reg::kReceiveTimes;
constexpr unsigned kLinkBit = 4;                // of port 0 in the DL status
constexpr std::uint16_t kFilterStart = 0x1000;  // a write of the speed counter resets the control loop
constexpr std::uint32_t kBehind = 0x80000000U;  // sign of the difference
constexpr std::int32_t kCloseNs = 1000;
constexpr unsigned kCloseReads = 3;
constexpr std::int32_t kFarNs = 50'000;  // so far a clock is set again: following would take it too long

}  // namespace

Clocks::Clocks(std::size_t slaves, Clock period)
    : slaves_(slaves), ports_(slaves), delays_(slaves), propagation_(slaves), lock_(period.count()) {}

void Clocks::found(std::size_t place, Clock now) noexcept {
  if (place < slaves_.size()) {
    slaves_[place].is_set = false;
    slaves_[place].close_reads = 0;
    slaves_[place].was_in_step = false;
    restart(now);
  }
}

void Clocks::count(std::size_t slaves_on_cable, Clock now) noexcept {
  if (slaves_on_cable != on_cable_ && !slaves_.empty()) {
    on_cable_ = slaves_on_cable;
    restart(now);
  }
}

void Clocks::restart(Clock now) noexcept {
  step_ = Step::Wait;
  begin_at_ = now + kQuiet;
}

// A step is done for the slaves that it concerns, one after another.
bool Clocks::concerns(std::size_t place) const noexcept {
  switch (step_) {
    case Step::Latch:
      return place == 0;
    case Step::Unit:
    case Step::Times:
    case Step::Delay:
      return has_clock(place);
    case Step::Offset:
    case Step::Filter:
      return has_clock(place) && !slaves_[place].is_set;
    case Step::Watch:
      return has_clock(place) && place != reference_;
    default:
      return true;
  }
}

bool Clocks::find_next() noexcept {
  const std::size_t count = std::min(on_cable_, slaves_.size());
  while (place_ < count && !concerns(place_)) {
    ++place_;
  }
  return place_ < count;
}

void Clocks::advance(Clock now) noexcept {
  ++place_;
  while (step_ != Step::Wait && !find_next()) {
    place_ = 0;
    if (step_ == Step::Watch) {
      find_next();
      return;
    }
    finish_step(now);
  }
}

void Clocks::finish_step(Clock now) noexcept {
  if (step_ == Step::Ports && !work_out()) {
    restart(now);
    return;
  }
  if (step_ == Step::Filter) {
    for (std::size_t i = 0; i < slaves_.size(); ++i) {
      slaves_[i].is_set = has_clock(i);
    }
  }
  step_ = static_cast<Step>(static_cast<int>(step_) + 1);
}

std::optional<Query> Clocks::query(Clock now) noexcept {
  if (step_ == Step::Wait) {
    if (now < begin_at_ || slaves_.empty() || on_cable_ == 0) {
      return std::nullopt;
    }
    step_ = Step::Features;
    place_ = 0;
  }
  if (place_ >= slaves_.size() || !concerns(place_)) {
    return std::nullopt;  // watches, and there is only one clock
  }
  const auto at = [this](std::uint16_t offset) { return address_of(position(place_), offset); };
  switch (step_) {
    case Step::Features:
      return Query{Command::Aprd, at(reg::kFeatures), {}, 2};
    case Step::Unit:
      return Query{Command::Aprd, at(reg::kSystemTime), {}, 4};
    case Step::Latch:
      store<std::uint32_t>(word_, 0, 0);
      latched_at_ = now;
      return Query{Command::Bwr, address_of(0, reg::kReceiveTimes), Bytes(word_).first(4), 0};
    case Step::Times:
      return Query{Command::Aprd, at(reg::kReceiveTimes), {}, kTimesBytes};
    case Step::Ports:
      return Query{Command::Aprd, at(reg::kDlStatus), {}, 2};
    case Step::Offset:
      store<std::int64_t>(word_, 0, slaves_[place_].offset);
      return Query{Command::Apwr, at(reg::kSystemTimeOffset), word_, 0};
    case Step::Delay:
      store<std::uint32_t>(word_, 0, delays_[place_]);
      return Query{Command::Apwr, at(reg::kSystemTimeDelay), Bytes(word_).first(4), 0};
    case Step::Filter:
      store<std::uint16_t>(word_, 0, kFilterStart);
      return Query{Command::Apwr, at(reg::kSpeedCounter), Bytes(word_).first(2), 0};
    default:
      return Query{Command::Aprd, at(reg::kSystemTimeDifference), {}, 4};
  }
}

void Clocks::lost(Clock now) noexcept {
  if (step_ != Step::Wait && step_ != Step::Watch) {
    restart(now);
  }
}

void Clocks::answer(Bytes data, bool is_answered, Clock now) noexcept {
  if (step_ == Step::Wait) {
    return;  // asked before a slave came or went
  }
  if (!is_answered && step_ == Step::Unit) {
    ports_[place_].has_clock = false;  // the chip could, but the device's EEPROM has switched its clock off
    advance(now);
    return;
  }
  if (!is_answered && step_ != Step::Watch) {
    restart(now);
    return;
  }
  if (is_answered) {
    take(data);
  }
  if (step_ == Step::Watch && std::abs(slaves_[place_].difference) > kFarNs) {
    slaves_[place_].difference = 0;
    found(place_, now);
  } else {
    advance(now);
  }
}

void Clocks::take(Bytes data) noexcept {
  Slave& slave = slaves_[place_];
  switch (step_) {
    case Step::Features:
      ports_[place_].has_clock = (load<std::uint16_t>(data, 0) & kHasClock) != 0;
      slave.is_long = (load<std::uint16_t>(data, 0) & kHasLongClock) != 0;
      return;
    case Step::Times:
      for (std::size_t port = 0; port < kPorts; ++port) {
        ports_[place_].arrival[port] = load<std::uint32_t>(data, port * sizeof(std::uint32_t));
      }
      slave.received = slave.is_long ? load<std::int64_t>(data, kUnitTimeAt) : load<std::uint32_t>(data, kUnitTimeAt);
      return;
    case Step::Ports:
      for (std::size_t port = 0; port < kPorts; ++port) {
        ports_[place_].is_open[port] = (unsigned{load<std::uint16_t>(data, 0)} >> (kLinkBit + port) & 1U) != 0;
      }
      return;
    case Step::Watch: {
      const auto word = load<std::uint32_t>(data, 0);
      const auto size = static_cast<std::int32_t>(word & ~kBehind);
      slave.difference = (word & kBehind) != 0 ? -size : size;
      if (size > kFarNs && std::exchange(slave.was_in_step, false)) {
        lost_ = Lost{place_, slave.difference};
      }
      slave.close_reads = size < kCloseNs ? slave.close_reads + 1 : 0;
      slave.was_in_step = slave.was_in_step || slave.close_reads >= kCloseReads;
      return;
    }
    default:
      return;
  }
}

// Decides which clock is the reference, and what has to be added to each clock. The reference goes on where it was, as
// far as the master knows it.
bool Clocks::work_out() noexcept {
  const std::size_t count = std::min(on_cable_, slaves_.size());
  is_tree_unclear_ = !propagation_.find(std::span(ports_).first(count), std::span(delays_).first(count));
  const auto found = std::find_if(ports_.begin(), ports_.begin() + static_cast<std::ptrdiff_t>(count),
                                  [](const PortTimes& ports) { return ports.has_clock; });
  const auto place = static_cast<std::size_t>(found - ports_.begin());
  if (is_tree_unclear_ || place == count) {
    reference_.reset();
    return false;
  }
  Slave& first = slaves_[place];
  if (!first.is_set) {
    first.offset = reference_ ? reference_time(latched_at_) - first.received : 0;
    passed_ns_ = first.received + first.offset;
    passed_at_ = latched_at_;
  }
  reference_ = place;
  for (std::size_t i = 0; i < count; ++i) {
    Slave& slave = slaves_[i];
    if (i != place && !slave.is_set) {
      slave.offset = first.received + first.offset + delays_[i] - slave.received;
    }
  }
  return true;
}

std::optional<std::size_t> Clocks::reference() const noexcept {
  return reference_ && slaves_[*reference_].is_set ? reference_ : std::nullopt;
}

std::int64_t Clocks::reference_time(Clock now) const noexcept {
  return passed_ns_ + (now - passed_at_).count();
}

// What a clock of 32 bits shows, as a time that does not wrap around: the nearest one to what the master expects.
std::int64_t Clocks::whole(std::int64_t reference_ns, Clock sent) const noexcept {
  const std::int64_t expected = reference_time(sent);
  return slaves_[*reference_].is_long ? reference_ns
                                      : expected + static_cast<std::int32_t>(static_cast<std::uint32_t>(reference_ns) -
                                                                             static_cast<std::uint32_t>(expected));
}

std::int64_t Clocks::since_passed(std::size_t place, std::int64_t shown) const noexcept {
  return slaves_[place].is_long
             ? shown - passed_ns_
             : static_cast<std::int32_t>(static_cast<std::uint32_t>(shown) - static_cast<std::uint32_t>(passed_ns_));
}

void Clocks::passed(std::int64_t reference_ns, Clock sent, Clock now) noexcept {
  reference_ns = whole(reference_ns, sent);
  // A reference that was off for a moment shows another time before it is found again.
  const std::int64_t jump = reference_ns - reference_time(sent);
  if (lock_.has_grid() && std::abs(jump) > kMaxJump.count()) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    lost_ = Lost{*reference_, static_cast<std::int32_t>(std::clamp(jump, -kMost, kMost))};
    found(*reference_, now);
    not_passed();
    return;
  }
  passed_ns_ = reference_ns;
  passed_at_ = sent;
  correction_ = lock_.step(reference_ns);
}

void Clocks::not_passed() noexcept {
  correction_ = lock_.coast();
}

bool Clocks::is_in_step(std::size_t place) const noexcept {
  return step_ == Step::Watch && lock_.has_grid() && slaves_[place].is_set &&
         (place == reference_ || slaves_[place].close_reads >= kCloseReads);
}

std::int64_t Clocks::next_pulse(Clock cycle, Clock shift, Clock ahead, Clock now) const noexcept {
  const std::int64_t first = lock_.grid_ns() + shift.count();
  const std::int64_t earliest = reference_time(now) + ahead.count();
  const std::int64_t past = earliest - first;
  return first + (past / cycle.count() + 1) * cycle.count();
}

}  // namespace indurop::io::ethercat
