// SPDX-License-Identifier: Apache-2.0
// Reads a configuration or the manifest of a plant and checks it, with the files of its robots.

#pragma once

#include <string>
#include <vector>

#include "config/check/check.h"
#include "config/check/check_plant.h"
#include "config/model/config.h"

namespace indurop::tools {

struct CheckedConfig {
  config::Config config;
  config::CheckResult check;
  std::vector<base::Diagnostic> diagnostics;  // of the reader and of the check
  [[nodiscard]] bool ok() const;
};

struct CheckedPlant {
  config::Plant plant;
  config::PlantCheck check;
  std::vector<base::Diagnostic> diagnostics;  // of the reader and of the check
  [[nodiscard]] bool ok() const;
};

CheckedConfig load_config(const std::string& file, const config::CheckOptions& options);
// The boards are other machines, so nothing is compared with this one.
CheckedPlant load_plant(const std::string& file, config::CheckOptions options);

}  // namespace indurop::tools
