// SPDX-License-Identifier: Apache-2.0
// modelDescription.xml of an FMU for co-simulation.

#pragma once

#include <string>
#include <vector>

#include "doors/fmi/description/choice.h"

namespace indurop::fmi {

struct Description {
  std::string model;       // name of the plant or of the configuration
  std::string identifier;  // of C; the name of the library, too
  std::string token;
  std::string tool;                              // "InduRoP 0.2.0"
  double period_s = 0;                           // basic period
  const std::vector<ChosenVariable>& variables;  // the value reference of the first one is 1
};

// Return the text for a version of the standard. An input has its initial value as start; an output has none, because
// modules calculate it, also at the start.
std::string fmi2_description(const Description& description);
std::string fmi3_description(const Description& description);

}  // namespace indurop::fmi
