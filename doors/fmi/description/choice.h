// SPDX-License-Identifier: Apache-2.0
// Which variables an FMU has, and which of them are inputs.

#pragma once

#include <indurop/result.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "config/check/uses.h"
#include "core/base/problem.h"
#include "doors/fmi/description/parts.h"

namespace indurop::fmi {

// A shared variable of the configuration.
struct SharedVariable {
  const schema::Variable* declaration = nullptr;
  std::vector<std::string> boards;   // as FmuVariable::boards: the first is read, an input is written on all
  std::vector<std::string> writers;  // modules
  bool read = false;                 // by a module
};
// Returns the variables that a module uses, by name. `views`, whose names are empty for a module.xml, are borrowed;
// `owners`: the board that owns each variable, as config::PlantCheck has it. `routed`: variables that travel between
// boards. If modules access variables by names that are known only at run time, all variables are returned.
std::vector<SharedVariable> shared_variables(std::span<const config::BoardView> views,
                                             const std::map<std::string, std::size_t>& owners,
                                             const std::set<std::string>& routed);

struct ChosenVariable {
  ShownPart part;
  const SharedVariable* shared = nullptr;
  bool input = false;
};
struct Choice {
  std::vector<ChosenVariable> variables;
  std::vector<std::string> warnings;
};
// Chooses by patterns, which match names of variables or of their parts. No `inputs`: the variables that no module
// writes. No `outputs`: all others. `variables` is borrowed. Errors: a pattern without a match, no variable, more than
// 100 000.
Result<Choice, base::Problem> choose(const std::vector<SharedVariable>& variables,
                                     const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace indurop::fmi
