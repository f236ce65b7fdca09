// SPDX-License-Identifier: Apache-2.0
// A board or a plant that becomes an FMU: read, checked, and its shared variables.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/check/check_plant.h"
#include "config/model/plant.h"
#include "core/base/diagnostic.h"
#include "doors/fmi/description/choice.h"

namespace indurop::fmi {

struct Configuration {
  bool is_plant = false;
  config::Plant plant;                      // of a module.xml: with one board
  std::vector<config::CheckResult> checks;  // of the boards
  std::vector<base::Diagnostic> diagnostics;
  std::vector<SharedVariable> variables;  // they point to `checks`; none after an error
  base::Nanos basic_period{};             // the shortest one of all boards; 0: no periodic modules
};

// Reads and checks a module.xml or the manifest of a plant.
Configuration load_configuration(const std::filesystem::path& file);

}  // namespace indurop::fmi
