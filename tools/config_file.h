// SPDX-License-Identifier: Apache-2.0
// What `check`, `plan` and `vars` have in common: read a configuration or the manifest of a plant, check it, print the
// diagnostics.

#pragma once

#include <optional>
#include <string>

#include "deploy/check.h"
#include "deploy/config.h"
#include "deploy/plant.h"
#include "tools/verb.h"

namespace indurop::tools {

struct CheckedConfig {
  deploy::Config config;
  deploy::CheckResult check;
  std::vector<deploy::Diagnostic> diagnostics;  // of the reader and of the check
  [[nodiscard]] bool ok() const;
};

struct CheckedPlant {
  deploy::Plant plant;
  deploy::PlantCheck check;
  std::vector<deploy::Diagnostic> diagnostics;  // of the reader and of the check
  [[nodiscard]] bool ok() const;
};

// The file to read: `file`, else ./module.xml, else ./plant.xml. Empty after an error message if there is no such file.
std::optional<std::string> find_config(Context& context, const std::string& file, int& code);
CheckedConfig load_config(const std::string& file, const deploy::CheckOptions& options);
// Boards are other machines: nothing is compared with this one.
CheckedPlant load_plant(const std::string& file, deploy::CheckOptions options);
// `as_data`: they are what the verb was asked for (stdout), else they are messages (stderr).
void print_diagnostics(Context& context, const std::vector<deploy::Diagnostic>& diagnostics, bool as_data);
// One line: OK and `content`, or FAILED and how many errors.
void print_verdict(Context& context, const std::vector<deploy::Diagnostic>& diagnostics, const std::string& content);
// "1 module", "2 modules"
std::string counted(std::size_t n, const char* noun);
JsonValue diagnostics_json(const std::vector<deploy::Diagnostic>& diagnostics);

}  // namespace indurop::tools
