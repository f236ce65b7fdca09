// SPDX-License-Identifier: Apache-2.0
// resources/indurop.json of an FMU: what the program that makes FMUs tells the library in them.

#pragma once

#include <indurop/result.h>

#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"

namespace indurop::fmi {

inline constexpr const char* kContentsName = "indurop.json";
inline constexpr const char* kConfigurationFolder = "project";  // in resources/

// A variable of the FMU: a part of a shared variable that is a number, a bool, a text or an enumerator.
struct FmuVariable {
  std::string name;  // "knu::Robot::joints[1].y"
  // Where it is: the first board is read, all are written. Empty names: the only board.
  std::vector<std::string> boards;
  bool input = false;
};

struct Contents {
  std::string token;          // guid of FMI 2, instantiationToken of FMI 3
  std::string configuration;  // path in kConfigurationFolder
  bool plant = false;         // it is the manifest of a plant
  std::string programs;       // folder of indurop-node where the FMU was made
  // Paths in kConfigurationFolder of what has to be executable: tools that unpack an FMU forget it.
  std::vector<std::string> executables;
  std::vector<FmuVariable> variables;  // the value reference of the first one is 1
};

std::string to_text(const Contents& contents);
// Errors: damaged, written by another version of InduRoP.
Result<Contents, base::Problem> read_contents(std::string_view text);

}  // namespace indurop::fmi
