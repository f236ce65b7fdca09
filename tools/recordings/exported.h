// SPDX-License-Identifier: Apache-2.0
// What an export of a recording makes: a text, and how much it tells.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace indurop::tools {

struct Exported {
  std::string text;
  std::uint64_t count = 0;           // rows, runs
  std::vector<std::string> damages;  // that were passed over
};

}  // namespace indurop::tools
