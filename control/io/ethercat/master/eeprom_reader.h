// SPDX-License-Identifier: Apache-2.0
// Reads eight bytes of a slave's EEPROM through its registers, with one access or two, as the slave can: one datagram
// each time it is asked. Takes the EEPROM from the processor of the device before.

#pragma once

#include <array>
#include <optional>

#include "control/io/ethercat/master/query.h"

namespace indurop::io::ethercat {

class EepromReader {
 public:
  enum class Outcome { Running, Done, Busy };  // Busy: the EEPROM did not answer within its time

  // Begins to read at this word.
  void start(std::uint16_t station, std::uint16_t word, Clock now) noexcept;
  [[nodiscard]] Query query() noexcept;
  // `is_answered`: the slave raised the working counter.
  Outcome answer(Bytes data, bool is_answered, Clock now) noexcept;
  [[nodiscard]] Bytes bytes() const noexcept { return bytes_; }

 private:
  enum class Step { Force, Take, Command, Poll, Data } step_ = Step::Force;
  std::uint16_t station_ = 0;
  std::uint16_t word_ = 0;
  std::size_t done_ = 0;
  std::size_t at_once_ = 0;
  std::array<std::uint8_t, 1> owner_{};
  std::array<std::uint8_t, 6> command_{};
  std::array<std::uint8_t, 8> bytes_{};
  Clock deadline_{0};
};

}  // namespace indurop::io::ethercat
