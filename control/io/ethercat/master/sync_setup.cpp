// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/sync_setup.h"

#include "control/io/ethercat/master/slave_control.h"

namespace indurop::io::ethercat {

namespace {

using std::chrono::milliseconds;

constexpr Clock kSyncPatience = milliseconds(10'000);  // for a clock to be in step
constexpr Clock kPulseCheck = milliseconds(100);
constexpr Clock kAhead = milliseconds(100);  // of the first pulse, so that it is not past when it is switched on

}  // namespace

void SyncSetup::start(Clock now) noexcept {
  step_ = Step::Await;
  since_ = now;
  pulse_after_.reset();
}

std::optional<Query> SyncSetup::query(Clock now) noexcept {
  const std::uint16_t station = station_of(place_);
  if (step_ == Step::Await && clocks_.is_in_step(place_)) {
    step_ = Step::Off;
  }
  switch (step_) {
    case Step::Await:
      return std::nullopt;
    case Step::Off:
      store<std::uint16_t>(word_, 0, 0);
      return Query{Command::Fpwr, address_of(station, reg::kSyncActivation), Bytes(word_).first(2), 0};
    case Step::Cycles:
      store<std::uint32_t>(word_, 0, static_cast<std::uint32_t>(plan_.cycle.count()));
      store<std::uint32_t>(word_, 4, static_cast<std::uint32_t>(plan_.sync1.count()));
      return Query{Command::Fpwr, address_of(station, reg::kSync0Cycle), word_, 0};
    case Step::Start:
      store<std::int64_t>(word_, 0, clocks_.next_pulse(plan_.cycle, plan_.shift, kAhead, now));
      return Query{Command::Fpwr, address_of(station, reg::kSyncStart), word_, 0};
    case Step::On:
      break;
  }
  store<std::uint16_t>(word_, 0, plan_.activation);
  return Query{Command::Fpwr, address_of(station, reg::kSyncActivation), Bytes(word_).first(2), 0};
}

SyncSetup::Outcome SyncSetup::answer(bool is_answered) noexcept {
  if (!is_answered || step_ == Step::Await) {
    return Outcome::Running;
  }
  if (step_ == Step::On) {
    return Outcome::Done;
  }
  step_ = static_cast<Step>(static_cast<int>(step_) + 1);
  return Outcome::Running;
}

SyncSetup::Outcome SyncSetup::outcome(Clock now) const noexcept {
  if (step_ != Step::Await) {
    return Outcome::Running;
  }
  if (clocks_.is_measured() && !clocks_.has_clock(place_)) {
    return Outcome::NoClock;
  }
  return now - since_ > kSyncPatience ? Outcome::NotInStep : Outcome::Running;
}

Query SyncSetup::pulse_query(Clock now) noexcept {
  ask_pulse_at_ = now + kPulseCheck;
  return Query{Command::Fprd, address_of(station_of(place_), reg::kSyncStart), {}, 8};
}

void SyncSetup::take_pulse(Bytes data) noexcept {
  const std::int64_t since_frame = clocks_.since_passed(place_, load<std::int64_t>(data, 0));
  const std::int64_t cycle = plan_.cycle.count();
  pulse_after_ = Clock((since_frame % cycle + cycle) % cycle);
}

}  // namespace indurop::io::ethercat
