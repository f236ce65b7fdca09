// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/pictures/histogram_bins.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using scheduler::Histogram;

// Returns a bar for `share` of `width` characters, in eighths if the terminal can show them; not empty for a share
// above 0.
std::string bar(double share, std::size_t width, bool unicode) {
  if (!unicode) {
    std::string plain(static_cast<std::size_t>(std::ceil(share * static_cast<double>(width))), '#');
    return plain;
  }
  static constexpr std::array kParts{"", "\u258f", "\u258e", "\u258d", "\u258c", "\u258b", "\u258a", "\u2589"};
  const auto eighths = static_cast<std::size_t>(std::ceil(share * static_cast<double>(width) * 8));
  std::string out;
  for (std::size_t i = 0; i < eighths / 8; ++i) {
    out += "\u2588";
  }
  return out + kParts[eighths % 8];
}

}  // namespace

std::vector<Bin> gather(const scheduler::HistogramCounts& histogram, std::size_t most) {
  std::size_t first = Histogram::kBuckets;
  std::size_t last = 0;
  for (std::size_t i = 0; i < Histogram::kBuckets; ++i) {
    if (histogram.counts[i] > 0) {
      first = std::min(first, i);
      last = i;
    }
  }
  std::vector<Bin> bins;
  if (first > last || most == 0) {
    return bins;
  }
  std::size_t group = 1;
  while (last / group - first / group + 1 > most) {
    group *= 2;
  }
  for (std::size_t g = first / group; g <= last / group; ++g) {
    const std::size_t begin = g * group;
    const std::size_t end = std::min(begin + group, Histogram::kBuckets);
    Bin bin{Histogram::lower_bound(begin), Histogram::upper_bound(end - 1), 0};
    for (std::size_t i = begin; i < end; ++i) {
      bin.count += histogram.counts[i];
    }
    bins.push_back(bin);
  }
  return bins;
}

std::vector<std::string> bar_lines(const std::vector<Bin>& bins, std::size_t bar_width, const Output& output) {
  std::uint64_t total = 0;
  std::uint64_t highest = 1;
  for (const Bin& bin : bins) {
    total += bin.count;
    highest = std::max(highest, bin.count);
  }
  std::vector<std::string> lines;
  for (const Bin& bin : bins) {
    const double share = static_cast<double>(bin.count) / static_cast<double>(std::max<std::uint64_t>(1, total));
    const std::string drawn =
        bar(static_cast<double>(bin.count) / static_cast<double>(highest), bar_width, output.unicode());
    const std::string gap(bar_width - std::min(bar_width, display_width(drawn)), ' ');
    lines.push_back(fmt::format("{:>9} .. {:<9} {}{} {:>10} {:>8}", human_ns(static_cast<std::int64_t>(bin.from_ns)),
                                human_ns(static_cast<std::int64_t>(bin.to_ns)), output.paint(Style::Accent, drawn), gap,
                                bin.count,
                                bin.count == 0   ? ""
                                : share < 0.0001 ? "<0.01 %"
                                                 : fmt::format("{:.2f} %", share * 100)));
  }
  return lines;
}

}  // namespace indurop::tools
