// SPDX-License-Identifier: Apache-2.0
// The distributed clock of a simulated chip: its time, how it follows the reference, and its pulses.
#include <algorithm>
#include <utility>

#include "control/io/ethercat/simulator/esc.h"

namespace indurop::io::ethercat {

Time Esc::local_time(Time now) const noexcept {
  constexpr std::int64_t kBillion = 1'000'000'000;
  const std::int64_t drifted =
      now.count() / kBillion * config_.drift_ppb + now.count() % kBillion * config_.drift_ppb / kBillion;
  return config_.clock_start + now + Time(drifted) + clock_adjusted_;
}

void Esc::add_drift(std::int64_t ppb, Time now) noexcept {
  const Time before = local_time(now);
  config_.drift_ppb += ppb;
  clock_adjusted_ += before - local_time(now);
}

Time Esc::long_time(Time now) const noexcept {
  return local_time(now) + Time(value<std::int64_t>(reg::kSystemTimeOffset));
}

Time Esc::system_time(Time now) const noexcept {
  const Time whole = long_time(now);
  return (config_.features & kHasLongClock) != 0 ? whole : Time(static_cast<std::uint32_t>(whole.count()));
}

void Esc::latch_receive_times(Time in, const Returns& returns) noexcept {
  if ((config_.features & kHasClock) == 0) {
    return;
  }
  const std::int64_t received = local_time(in).count();
  set<std::uint32_t>(reg::kReceiveTimes, static_cast<std::uint32_t>(received));
  for (std::size_t port = 1; port < kPorts; ++port) {
    if (returns[port]) {
      set<std::uint32_t>(reg::kReceiveTimes + port * sizeof(std::uint32_t),
                         static_cast<std::uint32_t>(local_time(*returns[port]).count()));
    }
  }
  const bool is_long = (config_.features & kHasLongClock) != 0;
  set<std::int64_t>(reg::kReceiveTimeUnit, is_long ? received : static_cast<std::uint32_t>(received));
}

// A clock is made faster or slower for a while, by a thousandth at most, so what it shows never jumps.
void Esc::follow_reference(Time received, Time now) noexcept {
  constexpr std::uint32_t kSlower = 0x80000000U;
  constexpr std::int64_t kShare = 1000;
  const auto delay = value<std::uint32_t>(reg::kSystemTimeDelay);
  const auto own = static_cast<std::uint32_t>(system_time(now).count());
  const auto reference = static_cast<std::uint32_t>(received.count()) + delay;
  const auto error = static_cast<std::int32_t>(own - reference);
  const auto size = static_cast<std::uint32_t>(error < 0 ? -std::int64_t{error} : error);
  set<std::uint32_t>(reg::kSystemTimeDifference, error < 0 ? size | kSlower : size);
  const std::int64_t most = (now - std::exchange(followed_at_, now)).count() / kShare;
  clock_adjusted_ -= Time(std::clamp<std::int64_t>(error / 4, -most, most));
}

// A clock of 32 bits compares 32 bits: its first pulse is at most two seconds away.
void Esc::start_pulses(Time now) noexcept {
  const Time here = long_time(now);
  const auto first = value<std::int64_t>(reg::kSyncStart);
  const std::int64_t ahead =
      (config_.features & kHasLongClock) != 0
          ? first - here.count()
          : static_cast<std::int32_t>(static_cast<std::uint32_t>(first) - static_cast<std::uint32_t>(here.count()));
  first_pulse_ = here + Time(ahead);
  has_pulses_ = wants_pulses() && value<std::uint32_t>(reg::kSync0Cycle) > 0 && ahead > 0;
}

// The register of the first pulse is read as the time of the next one.
void Esc::show_next_pulse(Time now) noexcept {
  if (!has_pulses_) {
    return;
  }
  const Time here = long_time(now);
  const Time cycle(value<std::uint32_t>(reg::kSync0Cycle));
  const Time next = here < first_pulse_ ? first_pulse_ : here + cycle - (here - first_pulse_) % cycle;
  const bool is_long = (config_.features & kHasLongClock) != 0;
  set<std::int64_t>(reg::kSyncStart, is_long ? next.count() : static_cast<std::uint32_t>(next.count()));
}

std::optional<Time> Esc::since_pulse(Time now) const noexcept {
  const Time since = long_time(now) - first_pulse_;
  return has_pulses_ && since.count() >= 0 ? std::optional(since % Time(value<std::uint32_t>(reg::kSync0Cycle)))
                                           : std::nullopt;
}

}  // namespace indurop::io::ethercat
