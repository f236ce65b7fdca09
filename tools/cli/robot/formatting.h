// SPDX-License-Identifier: Apache-2.0
// Lays out job files.

#pragma once

#include <string>
#include <vector>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct FormatOrder {
  std::vector<std::string> files;
  bool check = false;  // report only which files would change
};

// Returns the exit code. Files that cannot be read or written are reported; the others are formatted.
int format_jobs(Context& context, const FormatOrder& order);

}  // namespace indurop::tools
