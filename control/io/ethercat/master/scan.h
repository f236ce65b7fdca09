// SPDX-License-Identifier: Apache-2.0
// Asks who is on a bus: counts the slaves and reads the EEPROM of each, by their positions, so that nothing in them
// changes but who may read the EEPROM. Waits for answers: not for the tick.

#pragma once

#include <indurop/result.h>

#include <functional>
#include <string>
#include <vector>

#include "control/io/ethercat/master/query.h"
#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

struct FoundSlave {
  std::uint16_t alias = 0;
  AlState state = AlState::None;
  Sii sii;
  std::string problem;  // why its EEPROM could not be read; empty: it was
};

class Scan {
 public:
  // Waits until a frame may have come, and returns what time it is then.
  using Wait = std::function<Clock()>;
  Scan(Link& link, Wait wait);

  // The slaves in the order of the cable. Errors: none answers, or they stop to answer.
  Result<std::vector<FoundSlave>, std::string> run();

 private:
  struct Answer {
    std::uint16_t wkc = 0;
    std::vector<std::uint8_t> data;
  };
  std::optional<Answer> exchange(Command command, std::uint32_t address, Bytes data);
  std::optional<Answer> read(std::size_t place, std::uint16_t offset, std::size_t length);
  bool write(std::size_t place, std::uint16_t offset, Bytes data);
  FoundSlave identify(std::size_t place);
  bool read_eeprom(std::size_t place, std::size_t word, std::vector<std::uint8_t>& into);
  std::optional<std::vector<std::uint8_t>> read_image(std::size_t place);

  Link& link_;
  Wait wait_;
  FrameBuilder builder_;
  std::uint8_t index_ = 0;
};

}  // namespace indurop::io::ethercat
