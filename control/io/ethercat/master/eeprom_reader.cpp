// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/eeprom_reader.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {
constexpr Clock kEepromTimeout = std::chrono::milliseconds(100);
}  // namespace

void EepromReader::start(std::uint16_t station, std::uint16_t word, Clock now) noexcept {
  step_ = Step::Command;
  station_ = station;
  store<std::uint16_t>(command_, 0, kEepromRead);
  store<std::uint32_t>(command_, 2, word);
  deadline_ = now + kEepromTimeout;
}

Query EepromReader::query() noexcept {
  switch (step_) {
    case Step::Command:
      return {Command::Fpwr, address_of(station_, reg::kEepromControl), command_, 0};
    case Step::Poll:
      return {Command::Fprd, address_of(station_, reg::kEepromControl), {}, 2};
    case Step::Data:
      break;
  }
  return {Command::Fprd, address_of(station_, reg::kEepromData), {}, bytes_.size()};
}

EepromReader::Outcome EepromReader::answer(Bytes data, bool is_answered, Clock now) noexcept {
  if (now > deadline_) {
    return Outcome::Busy;
  }
  if (!is_answered) {
    return Outcome::Running;
  }
  switch (step_) {
    case Step::Command:
      step_ = Step::Poll;
      return Outcome::Running;
    case Step::Poll: {
      const auto status = load<std::uint16_t>(data, 0);
      if ((status & kEepromBusy) == 0) {
        step_ = (status & kEepromErrors) != 0 ? Step::Command : Step::Data;
      }
      return Outcome::Running;
    }
    case Step::Data:
      break;
  }
  std::copy_n(data.begin(), bytes_.size(), bytes_.begin());
  return Outcome::Done;
}

}  // namespace indurop::io::ethercat
