// SPDX-License-Identifier: Apache-2.0
// A histogram's many buckets gathered into as many bars as fit on a screen or a picture. Pure functions.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/quantile.h"
#include "tools/command/output.h"

namespace indurop::tools {

struct Bin {
  std::uint64_t from_ns = 0;  // included
  std::uint64_t to_ns = 0;    // not included
  std::uint64_t count = 0;
};

// At most `most` bins of equal width on the logarithmic scale, without empty ones at the ends.
std::vector<Bin> gather(const scheduler::HistogramCounts& histogram, std::size_t most);

// One line per bin: range, bar, count, share.
std::vector<std::string> bar_lines(const std::vector<Bin>& bins, std::size_t bar_width, const Output& output);

}  // namespace indurop::tools
