// SPDX-License-Identifier: Apache-2.0
// Reads eight bytes of a slave's EEPROM after another through its registers: one datagram each time it is asked.

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
  enum class Step { Command, Poll, Data } step_ = Step::Command;
  std::uint16_t station_ = 0;
  std::array<std::uint8_t, 6> command_{};
  std::array<std::uint8_t, 8> bytes_{};
  Clock deadline_{0};
};

}  // namespace indurop::io::ethercat
