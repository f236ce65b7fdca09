// SPDX-License-Identifier: Apache-2.0
// Shared by `check`, `plan` and `vars`: reads a configuration or the manifest of a plant, checks it, prints the
// diagnostics.

#pragma once

#include <optional>
#include <string>

#include "config/check/check.h"
#include "config/check/check_plant.h"
#include "config/model/config.h"
#include "tools/cli/command/verb.h"

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

// Returns the file to read: `file`, else ./module.xml, else ./plant.xml. Fails if there is no such file.
Result<std::string, Failure> find_config(const std::string& file);
CheckedConfig load_config(const std::string& file, const config::CheckOptions& options);
// The boards are other machines, so nothing is compared with this one.
CheckedPlant load_plant(const std::string& file, config::CheckOptions options);
// `as_data`: the diagnostics are the result of the verb (stdout), else they are messages (stderr).
void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics, bool as_data);
// Prints one line: OK and `content`, or FAILED and the number of errors.
void print_verdict(Context& context, const std::vector<base::Diagnostic>& diagnostics, const std::string& content);
// "1 module", "2 modules"
std::string counted(std::size_t n, const char* noun);
JsonValue diagnostics_json(const std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::tools
