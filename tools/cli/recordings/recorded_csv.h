// SPDX-License-Identifier: Apache-2.0
// Values of a recording as a CSV file, one column for each number.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "tools/cli/recordings/exported.h"

namespace indurop::tools {

struct CsvOptions {
  std::vector<std::string> names;  // globs of channels; none: all
  std::int64_t every_ns = 0;       // interval of the rows; 0: a row whenever a value changed
  bool units = false;
};

// Errors: not a recording; a name that is not in it.
Result<Exported, base::Problem> recorded_csv(const std::filesystem::path& file, const CsvOptions& options);

}  // namespace indurop::tools
