// SPDX-License-Identifier: Apache-2.0
// Combines a histogram's many buckets into as many bars as fit on a screen or a picture. Pure functions.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scheduler/quantile.h"
#include "tools/console/output.h"

namespace indurop::tools {

struct Bin {
  std::uint64_t from_ns = 0;  // included
  std::uint64_t to_ns = 0;    // not included
  std::uint64_t count = 0;
};

// Returns at most `most` bins of equal width on the logarithmic scale, without empty ones at the ends.
std::vector<Bin> gather(const scheduler::HistogramCounts& histogram, std::size_t most);

// Returns one line per bin: range, bar, count, share.
std::vector<std::string> bar_lines(const std::vector<Bin>& bins, std::size_t bar_width, const Output& output);

}  // namespace indurop::tools
