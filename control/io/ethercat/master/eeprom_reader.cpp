// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/eeprom_reader.h"

#include <algorithm>

namespace indurop::io::ethercat {

namespace {
constexpr Clock kEepromTimeout = std::chrono::milliseconds(100);
}  // namespace

void EepromReader::start(std::uint16_t station, std::uint16_t word, Clock now) noexcept {
  step_ = Step::Force;
  station_ = station;
  word_ = word;
  done_ = 0;
  deadline_ = now + kEepromTimeout;
}

Query EepromReader::query() noexcept {
  switch (step_) {
    case Step::Force:
    case Step::Take:
      owner_[0] = step_ == Step::Force ? kEepromForce : kEepromOfMaster;
      return {Command::Fpwr, address_of(station_, reg::kEepromConfig), owner_, 0};
    case Step::Command:
      store<std::uint16_t>(command_, 0, kEepromRead);
      store<std::uint32_t>(command_, 2, static_cast<std::uint32_t>(word_ + done_ / 2));
      return {Command::Fpwr, address_of(station_, reg::kEepromControl), command_, 0};
    case Step::Poll:
      return {Command::Fprd, address_of(station_, reg::kEepromControl), {}, 2};
    case Step::Data:
      break;
  }
  return {Command::Fprd, address_of(station_, reg::kEepromData), {}, at_once_};
}

EepromReader::Outcome EepromReader::answer(Bytes data, bool is_answered, Clock now) noexcept {
  if (now > deadline_) {
    return Outcome::Busy;
  }
  if (!is_answered) {
    return Outcome::Running;
  }
  switch (step_) {
    case Step::Force:
    case Step::Take:
    case Step::Command:
      step_ = static_cast<Step>(static_cast<int>(step_) + 1);
      return Outcome::Running;
    case Step::Poll: {
      const auto status = load<std::uint16_t>(data, 0);
      at_once_ = (status & kEepromEightBytes) != 0 ? bytes_.size() : bytes_.size() / 2;
      if ((status & kEepromBusy) == 0) {
        step_ = (status & kEepromErrors) != 0 ? Step::Command : Step::Data;
      }
      return Outcome::Running;
    }
    case Step::Data:
      break;
  }
  const std::size_t count = std::min(at_once_, bytes_.size() - done_);
  std::copy_n(data.begin(), count, bytes_.begin() + static_cast<std::ptrdiff_t>(done_));
  done_ += count;
  step_ = Step::Command;
  return done_ == bytes_.size() ? Outcome::Done : Outcome::Running;
}

}  // namespace indurop::io::ethercat
