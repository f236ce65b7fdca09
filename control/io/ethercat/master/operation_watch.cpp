// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/operation_watch.h"

namespace indurop::io::ethercat {

namespace {

constexpr Clock kStateCheck = std::chrono::milliseconds(10);

}  // namespace

void OperationWatch::begin(Clock now) noexcept {
  is_suspect_ = false;
  missed_state_ = false;
  check_at_ = now + kStateCheck;
  ports_.begin(now);
}

std::optional<Query> OperationWatch::query(Clock now) noexcept {
  if (is_suspect_ || now >= check_at_) {
    asks_ = Asks::State;
    return state_query(station_);
  }
  if (sync_.wants_pulse(now)) {
    asks_ = Asks::Pulse;
    return sync_.pulse_query(now);
  }
  if (ports_.is_due(now)) {
    asks_ = Asks::Ports;
    return ports_.query(station_, now);
  }
  asks_ = Asks::Mailbox;
  return mailbox_.is_open() ? mailbox_.query(now) : std::nullopt;
}

OperationWatch::Verdict OperationWatch::answer(Bytes data, bool is_answered, Clock now) noexcept {
  switch (asks_) {
    case Asks::Pulse:
      if (is_answered) {
        sync_.take_pulse(data);
      }
      return {};
    case Asks::Ports:
      if (is_answered) {
        take_ports(data, now);
      }
      return {};
    case Asks::Mailbox:
      mailbox_.answer(data, is_answered, now);
      if (const auto emergency = mailbox_.take_emergency()) {
        events_.push({now, place_, Problem::EmergencySent, emergency->code});
      }
      return {};
    case Asks::State:
      break;
  }
  check_at_ = now + kStateCheck;
  // A frame that is on its way while a cable of a ring is plugged in passes the slaves behind it at neither end. So one
  // query without an answer does not tell yet that the slave is missing.
  is_suspect_ = !is_answered && !missed_state_;
  missed_state_ = is_suspect_;
  if (is_suspect_) {
    return {};
  }
  if (!is_answered) {
    return {Problem::Missing, 0};
  }
  const bool in_op = data[0] == static_cast<unsigned>(AlState::Op);
  return in_op ? Verdict{} : Verdict{Problem::StateLost, load<std::uint16_t>(data, kStateCodeAt)};
}

void OperationWatch::take_ports(Bytes data, Clock now) noexcept {
  constexpr unsigned kPortShift = 16;
  const auto found = ports_.answer(data);
  if (found && found->broken_frames > 0) {
    events_.push({now, place_, Problem::BrokenFrames, std::uint32_t{found->port} << kPortShift | found->broken_frames});
  }
  if (found && found->lost_links > 0) {
    events_.push({now, place_, Problem::LostLink, std::uint32_t{found->port} << kPortShift | found->lost_links});
  }
}

void OperationWatch::suspect(std::uint16_t wkc, Clock now) noexcept {
  if (!is_suspect_) {
    events_.push({now, place_, Problem::WrongCounter, wkc});
  }
  is_suspect_ = true;
}

}  // namespace indurop::io::ethercat
