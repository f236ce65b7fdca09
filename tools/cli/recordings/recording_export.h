// SPDX-License-Identifier: Apache-2.0
// indurop recording export: values of a recording as CSV, its runs as a trace for Perfetto.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct ExportOptions {
  std::filesystem::path file;
  std::vector<std::string> names;  // with csv: variables, or globs; none: all
  std::string csv;                 // file names; empty: none
  std::string trace;
  std::int64_t every_ns = 0;  // with csv: interval of the rows; 0: a row whenever a value changed
  bool units = false;
};
// Returns the exit code.
int export_recording(Context& context, const ExportOptions& options);

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_recording_export(base::Options& app, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
