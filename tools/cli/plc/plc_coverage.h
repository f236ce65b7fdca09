// SPDX-License-Identifier: Apache-2.0
// indurop plc coverage: the lines, branches and coils of PLC programs that were executed, from the counters of modules
// that were built with --coverage.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/problem.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// The coverage of one file of a program, over all modules and runs.
struct FileCoverage {
  struct Line {
    std::uint64_t runs = 0;
    std::string pou;
    std::string drawn;  // "rung 3"; empty: a line of text
  };
  // A condition, or a coil.
  struct Outcome {
    std::string what;  // "coil Motor"; empty: a condition
    std::string pou;
    std::string drawn;
    std::uint64_t yes = 0;
    std::uint64_t no = 0;
  };
  std::map<int, Line> lines;
  std::map<std::pair<int, std::string>, Outcome> outcomes;  // by line and what
};
using Coverage = std::map<std::string, FileCoverage>;  // by file

// Adds the counters in a file. Errors: it is not a counter file, or is damaged.
Result<void, base::Problem> add_counters(const std::filesystem::path& path, Coverage& coverage);
// The coverage in the format of lcov and genhtml. Files of this machine are named by their full path.
std::string lcov_text(const Coverage& coverage);

// Prints the coverage from the counters in a folder in context.format; `lcov`: if not empty, also writes this file.
// Returns the exit code.
int show_coverage(Context& context, const std::filesystem::path& folder, const std::string& lcov);

// Adds the subcommand; after it was parsed, `chosen` is the action to run.
void add_plc_coverage(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen);

}  // namespace indurop::tools
