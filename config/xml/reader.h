// SPDX-License-Identifier: Apache-2.0
// Reads module.xml. Reports all errors at once; an unknown element is an error that proposes the nearest known name.
// Not real-time safe.

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "config/model/config.h"

namespace indurop::config {

struct ReadResult {
  Config config;                              // meaningful only if ok
  std::vector<base::Diagnostic> diagnostics;  // errors, warnings
  [[nodiscard]] bool ok() const noexcept;
};

// Files over 4 MB or nested deeper than 32 are reported as errors.
ReadResult read_config(const std::filesystem::path& file);
ReadResult read_config_text(std::string_view xml, const std::filesystem::path& pretend_file);

}  // namespace indurop::config
