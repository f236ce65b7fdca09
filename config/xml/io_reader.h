// SPDX-License-Identifier: Apache-2.0
// Reads ioconfig.xml.

#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "config/model/io_config.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

struct ReadIo {
  IoConfig config;
  std::vector<base::Diagnostic> diagnostics;
  [[nodiscard]] bool ok() const noexcept { return !base::has_error(diagnostics); }
};
// Reports all errors of the file at once. Not real-time safe.
ReadIo read_io_config(const std::filesystem::path& file);
ReadIo read_io_config_text(std::string_view xml, const std::filesystem::path& pretend_file);

}  // namespace indurop::config
