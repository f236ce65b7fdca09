// SPDX-License-Identifier: Apache-2.0
// What `check`, `plan` and `vars` have in common: read a configuration, check it, print the diagnostics.

#pragma once

#include <optional>
#include <string>

#include "deploy/check.h"
#include "deploy/config.h"
#include "tools/verb.h"

namespace indurop::tools {

struct CheckedConfig {
  deploy::Config config;
  deploy::CheckResult check;
  std::vector<deploy::Diagnostic> diagnostics;  // of the reader and of the check
  [[nodiscard]] bool ok() const;
};

// `file` empty: ./module.xml. Empty after an error message if there is no such file.
std::optional<CheckedConfig> load_config(Context& context, const std::string& file, const deploy::CheckOptions& options,
                                         int& code);
// `as_data`: they are what the verb was asked for (stdout), else they are messages (stderr).
void print_diagnostics(Context& context, const std::vector<deploy::Diagnostic>& diagnostics, bool as_data);
JsonValue diagnostics_json(const std::vector<deploy::Diagnostic>& diagnostics);

}  // namespace indurop::tools
