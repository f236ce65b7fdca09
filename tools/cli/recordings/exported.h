// SPDX-License-Identifier: Apache-2.0
// The result of exporting a recording: a text, and the amount of data.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace indurop::tools {

struct Exported {
  std::string text;
  std::uint64_t count = 0;           // rows, runs
  std::vector<std::string> damages;  // damage in the file that was skipped
};

}  // namespace indurop::tools
