// SPDX-License-Identifier: Apache-2.0
// Condenses one Distribution of the run block to a few values. For readers (tools, the node's report): works on a copy,
// so the values of one Summary are consistent although the writer continues.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

// All in ns; all 0 if nothing has been counted yet.
struct Summary {
  std::uint64_t count = 0;
  std::int64_t min = 0;
  std::int64_t mean = 0;
  std::int64_t p50 = 0;
  std::int64_t p99 = 0;
  std::int64_t p99_9 = 0;
  std::int64_t max = 0;
};

// The counts of a histogram at one moment, as consistent as a reader can get them while the writer runs.
struct HistogramCounts {
  std::array<std::uint64_t, Histogram::kBuckets> counts{};
  std::uint64_t total = 0;
};

inline void copy_counts(const Histogram& histogram, HistogramCounts& to) noexcept {
  to.total = 0;
  for (std::size_t i = 0; i < Histogram::kBuckets; ++i) {
    to.counts[i] = histogram.count(i);
    to.total += to.counts[i];
  }
}

// Returns the smallest value that `fraction` (0..1) of the samples do not exceed, interpolated inside its bucket: error
// at most 6 %. 0 if there are no samples.
inline std::int64_t quantile(const HistogramCounts& histogram, double fraction) noexcept {
  if (histogram.total == 0) {
    return 0;
  }
  const double exact = std::ceil(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(histogram.total));
  const auto rank = std::max<std::uint64_t>(1, static_cast<std::uint64_t>(exact));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < Histogram::kBuckets; ++i) {
    const std::uint64_t here = histogram.counts[i];
    if (below + here >= rank) {
      const auto low = static_cast<double>(Histogram::lower_bound(i));
      const auto last = static_cast<double>(Histogram::upper_bound(i) - 1);
      const double part = here > 1 ? static_cast<double>(rank - below - 1) / static_cast<double>(here - 1) : 0.5;
      return static_cast<std::int64_t>(low + (last - low) * part);
    }
    below += here;
  }
  return static_cast<std::int64_t>(Histogram::upper_bound(Histogram::kBuckets - 1));
}

// Quantiles are never outside [min, max], which are exact.
inline Summary summarize(const Distribution& distribution) noexcept {
  Summary out;
  HistogramCounts histogram;
  copy_counts(distribution.histogram, histogram);
  out.count = distribution.count.load(std::memory_order_acquire);
  if (out.count == 0 || histogram.total == 0) {
    return Summary{};
  }
  out.min = distribution.min.load(std::memory_order_relaxed);
  out.max = std::max(out.min, distribution.max.load(std::memory_order_relaxed));
  const std::int64_t sum = distribution.sum.load(std::memory_order_relaxed);
  out.mean = std::clamp(sum / static_cast<std::int64_t>(out.count), out.min, out.max);
  for (const auto& [fraction, to] : {std::pair{0.5, &out.p50}, {0.99, &out.p99}, {0.999, &out.p99_9}}) {
    *to = std::clamp(quantile(histogram, fraction), out.min, out.max);
  }
  return out;
}

}  // namespace indurop::scheduler
