// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/slave_control.h"

#include <algorithm>
#include <array>

namespace indurop::io::ethercat {

namespace {

using std::chrono::milliseconds;

constexpr Clock kAnswerLimit = milliseconds(50);  // without an answer, the slave is missing
constexpr Clock kFindAgain = milliseconds(20);
constexpr Clock kRefusedPause = milliseconds(200);  // for what a new try hardly mends
constexpr std::size_t kStationBytes = 4;            // station address, alias
constexpr std::size_t kChannelBytes = 6;            // from their number to the features
constexpr std::size_t kMaxChannels = 16;            // FMMUs, SyncManagers
constexpr std::array<std::uint8_t, kMaxChannels * kFmmuBytes> kZeros{};

// How long a slave may take to a state, as the standard's defaults are.
constexpr Clock limit_of(AlState state) noexcept {
  return state == AlState::Init || state == AlState::PreOp ? milliseconds(3000) : milliseconds(10'000);
}

}  // namespace

SlaveControl::SlaveControl(const SlavePlan& plan, std::size_t place, Events& events, Clocks& clocks)
    : plan_(plan),
      place_(static_cast<std::uint16_t>(place)),
      events_(events),
      expected_(static_cast<std::uint16_t>((plan.output_bytes > 0 ? 2 : 0) + (plan.input_bytes > 0 ? 1 : 0))),
      sync_(plan.sync, place, clocks),
      operation_(place_, station_of(place), mailbox_, sync_, events) {
  if (!plan.mailbox_managers.empty()) {
    mailbox_.open(station_of(place), plan.mailbox);
  }
}

void SlaveControl::enter(Step step, Clock now) noexcept {
  step_ = step;
  since_ = now;
}

void SlaveControl::request(AlState state, Clock now) noexcept {
  target_ = state;
  const unsigned acknowledge = state == AlState::Init ? kAlError : 0U;
  store<std::uint16_t>(word_, 0, static_cast<std::uint16_t>(static_cast<unsigned>(state) | acknowledge));
  enter(Step::Request, now);
}

void SlaveControl::fail(Problem problem, std::uint32_t detail, Clock pause, Clock now) noexcept {
  if (problem_ != problem || detail_ != detail) {
    events_.push({now, place_, problem, detail,
                  static_cast<std::uint32_t>(transfer_.index) << 8U | static_cast<std::uint32_t>(transfer_.subindex)});
  }
  problem_ = problem;
  detail_ = detail;
  resume_at_ = now + pause;
  mailbox_.reset();
  enter(Step::Pause, now);
}

bool SlaveControl::start(SdoTransfer& transfer, Clock now) noexcept {
  if (!operates() || !mailbox_.is_open() || !mailbox_.is_idle()) {
    return false;
  }
  mailbox_.start(transfer, now);
  return true;
}

std::optional<Query> SlaveControl::query(Clock now) noexcept {
  const std::uint16_t station = station_of(place_);
  if (step_ == Step::Pause && now >= resume_at_) {
    answered_at_ = now;
    enter(Step::Find, now);
  }
  switch (step_) {
    case Step::Pause:
      return std::nullopt;
    case Step::Find:
      return Query{Command::Aprd, address_of(position(place_), reg::kStation), {}, kStationBytes};
    case Step::Address:
      store<std::uint16_t>(word_, 0, station);
      return Query{Command::Apwr, address_of(position(place_), reg::kStation), word_, 0};
    case Step::Channels:
      return Query{Command::Fprd, address_of(station, reg::kFmmuCount), {}, kChannelBytes};
    case Step::ClearFmmus:
      return Query{Command::Fpwr, address_of(station, reg::kFmmu), Bytes(kZeros).first(fmmus_ * kFmmuBytes), 0};
    case Step::ClearManagers:
      return Query{Command::Fpwr, address_of(station, reg::kSyncManager),
                   Bytes(kZeros).first(managers_ * kSyncManagerBytes), 0};
    case Step::Identity:
      return eeprom_.query();
    case Step::Request:
      return Query{Command::Fpwr, address_of(station, reg::kAlControl), word_, 0};
    case Step::Wait:
      return state_query(station);
    case Step::Release:
      word_[0] = kEepromOfDevice;
      return Query{Command::Fpwr, address_of(station, reg::kEepromConfig), Bytes(word_).first(1), 0};
    case Step::Mailbox:
      return Query{Command::Fpwr, address_of(station, reg::kSyncManager), plan_.mailbox_managers, 0};
    case Step::Objects: {
      auto asked = mailbox_.query(now);
      judge_object(now);
      return step_ == Step::Objects ? asked : std::nullopt;
    }
    case Step::Managers:
      return Query{Command::Fpwr, address_of(station, plan_.process_managers_at), plan_.process_managers, 0};
    case Step::Fmmus:
      return Query{Command::Fpwr, address_of(station, reg::kFmmu), plan_.fmmus, 0};
    case Step::Sync: {
      const auto asked = sync_.query(now);
      judge_sync(sync_.outcome(now), now);
      return step_ == Step::Sync ? asked : std::nullopt;
    }
    case Step::Operate:
      break;
  }
  return operation_.query(now);
}

void SlaveControl::lost(Clock now) noexcept {
  if (step_ == Step::Objects || (step_ == Step::Operate && operation_.asks_mailbox())) {
    mailbox_.lost(now);
  }
  if (step_ != Step::Pause && now - answered_at_ > kAnswerLimit) {
    fail(Problem::Missing, 0, kFindAgain, now);
  }
}

void SlaveControl::answer(Bytes data, bool is_answered, Clock now) noexcept {
  answered_at_ = now;
  if (step_ == Step::Operate) {
    if (const auto verdict = operation_.answer(data, is_answered, now); verdict.problem != Problem::None) {
      fail(verdict.problem, verdict.detail, Clock(0), now);
    }
    return;
  }
  if (step_ == Step::Objects) {
    mailbox_.answer(data, is_answered, now);
    judge_object(now);
    return;
  }
  if (step_ == Step::Identity) {
    check_identity(data, is_answered, now);
    return;
  }
  if (step_ == Step::Sync && is_answered) {
    judge_sync(sync_.answer(true), now);
    return;
  }
  if (!is_answered) {
    if (step_ == Step::Find || now - since_ > kAnswerLimit) {
      fail(Problem::Missing, 0, kFindAgain, now);
    }
    return;
  }
  finish_step(data, now);
}

void SlaveControl::finish_step(Bytes data, Clock now) noexcept {
  switch (step_) {
    case Step::Find:
      found(load<std::uint16_t>(data, 0), load<std::uint16_t>(data, 2), now);
      return;
    case Step::Address:
      sync_.slave_found(now);
      request(AlState::Init, now);
      return;
    case Step::Channels:
      fmmus_ = std::min<std::size_t>(data[0], kMaxChannels);
      managers_ = std::min<std::size_t>(data[1], kMaxChannels);
      has_lrw_ = (load<std::uint16_t>(data, reg::kFeatures - reg::kFmmuCount) & kNoLrw) == 0;
      enter(Step::ClearFmmus, now);
      return;
    case Step::ClearFmmus:
      enter(Step::ClearManagers, now);
      return;
    case Step::ClearManagers:
      eeprom_word_ = kSiiIdentity;
      eeprom_.start(station_of(place_), eeprom_word_, now);
      enter(Step::Identity, now);
      return;
    case Step::Request:
      enter(Step::Wait, now);
      return;
    case Step::Wait:
      check_state(data, now);
      return;
    case Step::Release:
      if (!plan_.mailbox_managers.empty()) {
        enter(Step::Mailbox, now);
        return;
      }
      [[fallthrough]];
    case Step::Mailbox:
      request(AlState::PreOp, now);
      return;
    case Step::Managers:
      if (!plan_.fmmus.empty()) {
        enter(Step::Fmmus, now);
        return;
      }
      [[fallthrough]];
    case Step::Fmmus:
      if (plan_.sync.activation != 0) {
        sync_.start(now);
        enter(Step::Sync, now);
      } else {
        request(AlState::SafeOp, now);
      }
      return;
    default:
      return;
  }
}

void SlaveControl::found(std::uint16_t station, std::uint16_t alias, Clock now) noexcept {
  // A slave that has one of our names already, but not this one's, is elsewhere in the configuration: giving it a
  // second name would hide it.
  if (station != station_of(place_) && station >= station_of(0) && station < 0x2000) {
    fail(Problem::Moved, station, kFindAgain, now);
    return;
  }
  if (plan_.alias != 0 && alias != plan_.alias) {
    fail(Problem::WrongAlias, alias, kRefusedPause, now);
    return;
  }
  enter(Step::Address, now);
}

void SlaveControl::check_identity(Bytes data, bool is_answered, Clock now) noexcept {
  const auto outcome = eeprom_.answer(data, is_answered, now);
  if (outcome == EepromReader::Outcome::Busy) {
    fail(is_answered ? Problem::EepromBusy : Problem::Missing, 0, kFindAgain, now);
    return;
  }
  if (outcome == EepromReader::Outcome::Running) {
    return;
  }
  const auto low = load<std::uint32_t>(eeprom_.bytes(), 0);
  const auto high = load<std::uint32_t>(eeprom_.bytes(), 4);
  if (eeprom_word_ == kSiiIdentity) {
    identity_.vendor = low;
    identity_.product = high;
    eeprom_word_ = kSiiIdentity + 4;
    eeprom_.start(station_of(place_), eeprom_word_, now);
    return;
  }
  identity_.revision = low;
  identity_.serial = high;
  const Identity& wanted = plan_.identity;
  if (identity_.vendor != wanted.vendor || identity_.product != wanted.product ||
      (wanted.revision != 0 && identity_.revision != wanted.revision) ||
      (wanted.serial != 0 && identity_.serial != wanted.serial)) {
    fail(Problem::WrongIdentity, identity_.product, kRefusedPause, now);
  } else if (plan_.uses_lrw && !has_lrw_) {
    fail(Problem::NoLrw, 0, kRefusedPause, now);
  } else {
    enter(Step::Release, now);
  }
}

void SlaveControl::check_state(Bytes data, Clock now) noexcept {
  const auto status = data[0];
  // In INIT a slave without a processor shows the bit with which the master acknowledges errors.
  const bool has_error = (status & kAlError) != 0 && target_ != AlState::Init;
  if ((status & kAlStateMask) == static_cast<unsigned>(target_) && !has_error) {
    reached(now);
  } else if (has_error) {
    fail(Problem::StateRefused, load<std::uint16_t>(data, kStateCodeAt), kRefusedPause, now);
  } else if (now - since_ > limit_of(target_)) {
    fail(Problem::StateTimeout, static_cast<std::uint32_t>(target_), kRefusedPause, now);
  }
}

void SlaveControl::reached(Clock now) noexcept {
  switch (target_) {
    case AlState::Init:
      // What another master left in it would answer for the process data of others.
      mailbox_.reset();
      enter(Step::Channels, now);
      return;
    case AlState::PreOp:
      object_ = 0;
      next_object(now);
      return;
    case AlState::SafeOp:
      request(AlState::Op, now);
      return;
    default:
      events_.push({now, place_, Problem::None, 0});
      problem_ = Problem::None;
      detail_ = 0;
      operation_.begin(now);
      enter(Step::Operate, now);
      return;
  }
}

void SlaveControl::next_object(Clock now) noexcept {
  if (object_ == plan_.start_objects.size()) {
    if (plan_.process_managers.empty()) {
      request(AlState::SafeOp, now);
    } else {
      enter(Step::Managers, now);
    }
    return;
  }
  const StartObject& object = plan_.start_objects[object_];
  transfer_ = {};
  transfer_.index = object.index;
  transfer_.subindex = object.subindex;
  transfer_.complete = object.complete;
  transfer_.sent = object.value;
  enter(Step::Objects, now);
  mailbox_.start(transfer_, now);
}

void SlaveControl::judge_object(Clock now) noexcept {
  switch (transfer_.state) {
    case SdoTransfer::State::Waiting:
      return;
    case SdoTransfer::State::Done:
      ++object_;
      next_object(now);
      return;
    case SdoTransfer::State::Aborted:
      fail(Problem::SdoAborted, transfer_.abort_code, kRefusedPause, now);
      return;
    case SdoTransfer::State::TimedOut:
      fail(Problem::SdoTimeout, transfer_.index, kFindAgain, now);
      return;
  }
}

void SlaveControl::judge_sync(SyncSetup::Outcome outcome, Clock now) noexcept {
  switch (outcome) {
    case SyncSetup::Outcome::Running:
      return;
    case SyncSetup::Outcome::Done:
      request(AlState::SafeOp, now);
      return;
    case SyncSetup::Outcome::NoClock:
      fail(Problem::NoClock, 0, kRefusedPause, now);
      return;
    case SyncSetup::Outcome::NotInStep:
      fail(Problem::ClockNotInStep, static_cast<std::uint32_t>(sync_.difference_ns()), kRefusedPause, now);
      return;
  }
}

void SlaveControl::check_counter(std::uint16_t wkc, Clock now) noexcept {
  if (!operates() || wkc == expected_) {
    return;
  }
  ++wrong_counters_;
  operation_.suspect(wkc, now);
}

}  // namespace indurop::io::ethercat
