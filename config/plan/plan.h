// SPDX-License-Identifier: Apache-2.0
// The schedule of a configuration for people and programs: Table 3 as text, stable JSON, and a timing diagram (SVG)
// like Figure 2.

#pragma once

#include <string>

#include "config/check/check.h"
#include "config/check/check_plant.h"
#include "config/model/config.h"

namespace indurop::config {

std::string plan_table(const Config& config, const CheckResult& check);
std::string plan_csv(const Config& config, const CheckResult& check);
// Explains which core each periodic module is on, why, and which modules wait for which.
std::string plan_why(const Config& config, const CheckResult& check);
std::string plan_why(const Plant& plant, const PlantCheck& check);
// {"basic_period_ns","macro_period_ns","slots":[{"slot","time_ns","modules":[names in order]}],"sporadic":[...],
//  "non_real":[...]}
std::string plan_json(const Config& config, const CheckResult& check);
std::string plan_svg(const Config& config, const CheckResult& check);

// The same for all boards in the order of the manifest: tables under headings; {"plant","boards":[{"name", then as
// above}]}; the board's name in the first column; diagrams one below the other.
std::string plan_table(const Plant& plant, const PlantCheck& check);
std::string plan_csv(const Plant& plant, const PlantCheck& check);
std::string plan_json(const Plant& plant, const PlantCheck& check);
std::string plan_svg(const Plant& plant, const PlantCheck& check);

}  // namespace indurop::config
