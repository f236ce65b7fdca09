// SPDX-License-Identifier: Apache-2.0
// indurop recording export: values of a recording as CSV, its runs as a trace for Perfetto.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/command/verb.h"

namespace indurop::tools {

struct ExportWish {
  std::filesystem::path file;
  std::vector<std::string> names;  // with csv: variables, or globs; none: all
  std::string csv;                 // files; empty: none
  std::string trace;
  std::int64_t every_ns = 0;  // with csv: a row each so much time; 0: whenever something changed
  bool units = false;
};
// Returns the exit code.
int export_recording(Context& context, const ExportWish& wish);

// Adds the subcommand; once it was parsed, `chosen` is what to do.
void add_recording_export(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
