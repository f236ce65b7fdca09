// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/simulator/bus.h"

#include <algorithm>
#include <utility>

namespace indurop::io::ethercat {

namespace {
constexpr std::size_t kProductAt = 0x14;  // in the EEPROM
constexpr std::size_t kFmmuLogical = reg::kFmmu;
constexpr std::int64_t kPpm = 1000;  // 1e-9

// What a slave does wrong while it starts.
void begin_after_restart(const Fault& fault, Slave& slave) {
  const Time end = fault.at + fault.duration;
  if (fault.kind == FaultKind::SdoAborted) {
    slave.sdo().refuse_next(fault.value);
  } else if (fault.kind == FaultKind::SdoSilence) {
    slave.sdo().refuse_next(0);
  } else if (fault.kind == FaultKind::SdoRepeated) {
    slave.repeat_answers(end);
  } else if (fault.kind == FaultKind::StateSlow) {
    slave.slow_down(Time(fault.value), end);
  } else {
    slave.esc().hold_eeprom_busy(end);
  }
}
}  // namespace

void SimulatedBus::advance(Time now) {
  now_ = now;
  for (Planned& planned : faults_) {
    if (!planned.has_begun && planned.fault.at <= now) {
      planned.has_begun = true;
      begin(planned.fault);
    }
    if (planned.has_begun && planned.fault.at + planned.fault.duration <= now) {
      planned.has_ended = true;
      end(planned.fault);
    }
  }
  std::erase_if(faults_, [](const Planned& planned) { return planned.has_ended; });
}

void SimulatedBus::restart(std::size_t slave) {
  segment_.set_power(slave, false);
  segment_.set_power(slave, true);
}

void SimulatedBus::add_to_product(std::size_t slave, std::uint32_t number) {
  auto& image = segment_.slave(slave).esc().eeprom();
  store<std::uint32_t>(image, kProductAt, load<std::uint32_t>(image, kProductAt) + number);
}

Link& SimulatedBus::make_ring() {
  segment_.make_ring();
  return last_end_;
}

void SimulatedBus::begin(const Fault& fault) {
  if (fault.kind == FaultKind::CableCut && fault.slave <= segment_.size()) {
    segment_.set_cable(fault.slave, false);
  }
  if (fault.slave >= segment_.size()) {
    return;
  }
  Slave& slave = segment_.slave(fault.slave);
  switch (fault.kind) {
    case FaultKind::PowerOff:
      segment_.set_power(fault.slave, false);
      return;
    case FaultKind::StateRefused:
      slave.refuse_state(AlState::Op, static_cast<std::uint16_t>(fault.value), 1);
      slave.fall_to(AlState::SafeOp, static_cast<std::uint16_t>(fault.value));
      return;
    case FaultKind::StateLost:
      slave.fall_to(AlState::SafeOp, static_cast<std::uint16_t>(fault.value));
      return;
    case FaultKind::SdoAborted:
    case FaultKind::SdoSilence:
    case FaultKind::SdoRepeated:
    case FaultKind::StateSlow:
    case FaultKind::EepromBusy:
      restart(fault.slave);
      begin_after_restart(fault, slave);
      return;
    case FaultKind::OtherIdentity:
      add_to_product(fault.slave, 1);
      restart(fault.slave);
      return;
    case FaultKind::Emergency:
      slave.send_emergency({static_cast<std::uint16_t>(fault.value), 1, {}});
      return;
    case FaultKind::ClockJumps:
      slave.esc().jump_clock(Time(fault.value));
      return;
    case FaultKind::ClockDrifts:
      slave.esc().add_drift(fault.value * kPpm, now_);
      return;
    case FaultKind::ObjectSet: {
      const auto value = slave.objects().storage(static_cast<std::uint16_t>(fault.object >> 8U),
                                                 static_cast<std::uint8_t>(fault.object));
      for (std::size_t i = 0; i < value.size(); ++i) {
        value[i] = i < sizeof(fault.value) ? static_cast<std::uint8_t>(fault.value >> (8U * i)) : std::uint8_t{0};
      }
      return;
    }
    case FaultKind::ForeignFrame: {
      FrameBuilder builder({2, 9, 9, 9, 9, 9});
      builder.add(Command::Brd, 0, address_of(0, 0xFFFF), 1);
      arrive({now_, Segment::End::First}, builder.finish());
      return;
    }
    default:
      return;  // concerns frames while it lasts
  }
}

void SimulatedBus::end(const Fault& fault) {
  if (fault.kind == FaultKind::CableCut && fault.slave <= segment_.size()) {
    segment_.set_cable(fault.slave, true);
  }
  if (fault.slave >= segment_.size()) {
    return;
  }
  if (fault.kind == FaultKind::PowerOff) {
    segment_.set_power(fault.slave, true);
  } else if (fault.kind == FaultKind::ClockDrifts) {
    segment_.slave(fault.slave).esc().add_drift(-(fault.value * kPpm), now_);
  } else if (fault.kind == FaultKind::OtherIdentity) {
    add_to_product(fault.slave, 0U - 1U);
  }
}

const Fault* SimulatedBus::active(FaultKind kind) const noexcept {
  const auto found = std::find_if(faults_.begin(), faults_.end(), [kind](const Planned& planned) {
    return planned.fault.kind == kind && planned.has_begun;
  });
  return found == faults_.end() ? nullptr : &found->fault;
}

void SimulatedBus::arrive(Segment::Passed passed, Bytes frame) {
  Arrival arrival;
  arrival.passed = passed;
  arrival.size = std::min(frame.size(), arrival.bytes.size());
  std::copy_n(frame.begin(), arrival.size, arrival.bytes.begin());
  arrivals_.push_back(arrival);
}

void SimulatedBus::spoil_counter(std::span<std::uint8_t> frame, std::size_t slave) noexcept {
  const auto logical = segment_.slave(slave).esc().value<std::uint32_t>(kFmmuLogical);
  FrameReader reader(frame);
  Datagram datagram;
  while (reader.next(datagram)) {
    if (is_logical(datagram.command) && datagram.address == logical && datagram.wkc > 0) {
      store<std::uint16_t>(frame, datagram.wkc_at(), static_cast<std::uint16_t>(datagram.wkc - 1));
    }
  }
}

bool SimulatedBus::send(Bytes frame, Segment::End end) noexcept {
  std::array<std::uint8_t, kMaxFrame> copy{};
  const auto bytes = std::span(copy).first(std::min(frame.size(), copy.size()));
  std::copy_n(frame.begin(), bytes.size(), bytes.begin());
  if (active(FaultKind::FramesLost) != nullptr) {
    return true;
  }
  if (const Fault* const broken = active(FaultKind::FramesBroken);
      broken != nullptr && broken->slave < segment_.size()) {
    segment_.break_frame_at(broken->slave);
    return true;
  }
  auto passed = segment_.pass(bytes, now_, end);
  if (!passed) {
    return true;
  }
  if (const Fault* const wrong = active(FaultKind::WrongCounter); wrong != nullptr && wrong->slave < segment_.size()) {
    spoil_counter(bytes, wrong->slave);
  }
  if (const Fault* const late = active(FaultKind::FramesLate)) {
    passed->back += Time(late->value);
  }
  arrive(*passed, bytes);
  if (active(FaultKind::FramesSwapped) != nullptr && arrivals_.size() > 1) {
    std::swap(arrivals_.back(), arrivals_[arrivals_.size() - 2]);
  }
  if (active(FaultKind::FramesDoubled) != nullptr) {
    arrive(*passed, bytes);
  }
  return true;
}

std::optional<Time> SimulatedBus::next_arrival() const noexcept {
  const auto next = std::min_element(arrivals_.begin(), arrivals_.end(),
                                     [](const Arrival& a, const Arrival& b) { return a.passed.back < b.passed.back; });
  return next == arrivals_.end() ? std::nullopt : std::optional(next->passed.back);
}

std::size_t SimulatedBus::receive(std::span<std::uint8_t> to, Segment::End end) noexcept {
  const auto next = std::find_if(arrivals_.begin(), arrivals_.end(), [this, end](const Arrival& arrival) {
    return arrival.passed.at == end && arrival.passed.back <= now_;
  });
  if (next == arrivals_.end()) {
    return 0;
  }
  const std::size_t size = next->size;
  std::copy_n(next->bytes.begin(), std::min(size, to.size()), to.begin());
  arrivals_.erase(next);
  return size;
}

}  // namespace indurop::io::ethercat
