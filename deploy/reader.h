// SPDX-License-Identifier: Apache-2.0
// Reads module.xml. The only place with XML. Reports everything wrong in one go; unknown elements are errors with the
// nearest known name. Not real-time safe.

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "deploy/config.h"

namespace indurop::deploy {

struct ReadResult {
  Config config;                        // meaningful only if ok
  std::vector<Diagnostic> diagnostics;  // errors, warnings
  [[nodiscard]] bool ok() const noexcept;
};

// Files over 4 MB or nested deeper than 32 are errors, never crashes.
ReadResult read_config(const std::filesystem::path& file);
ReadResult read_config_text(std::string_view xml, const std::filesystem::path& pretend_file);

// "500000" (ns), "100us", "1ms", "0.5ms", "2s", "10kHz". Empty if not a duration or not positive.
std::optional<Nanos> parse_duration(std::string_view text);
// "100 us", "1 ms", "2.5 ms": the shortest exact form.
std::string format_duration(Nanos value);

}  // namespace indurop::deploy
