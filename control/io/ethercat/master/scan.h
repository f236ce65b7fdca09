// SPDX-License-Identifier: Apache-2.0
// Asks who is on a bus: counts the slaves and reads the EEPROM of each, by their positions, so that nothing in them
// changes but who may read the EEPROM. Waits for answers: not for the tick.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/io/ethercat/master/requester.h"
#include "control/io/ethercat/sii.h"

namespace indurop::io::ethercat {

struct FoundSlave {
  std::uint16_t alias = 0;
  AlState state = AlState::None;
  std::uint16_t features = 0;  // of its chip, as the register says
  Sii sii;
  std::string problem;  // why its EEPROM could not be read; empty: it was
};

class Scan {
 public:
  Scan(Link& link, Requester::Wait wait) : requester_(link, std::move(wait)) {}

  // The slaves in the order of the cable. Errors: none answers, or they stop to answer.
  Result<std::vector<FoundSlave>, std::string> run();

 private:
  FoundSlave identify(std::size_t place);
  bool read_eeprom(std::size_t place, std::size_t word, std::vector<std::uint8_t>& into);
  std::optional<std::vector<std::uint8_t>> read_image(std::size_t place);

  Requester requester_;
};

}  // namespace indurop::io::ethercat
