// SPDX-License-Identifier: Apache-2.0
// Draws histograms as SVG: one panel per module, both axes logarithmic, quantiles marked. Pure functions.

#pragma once

#include <span>
#include <string>

#include "scheduler/quantile.h"

namespace indurop::tools {

struct HistogramPanel {
  std::string title;     // module
  std::string subtitle;  // what was measured
  scheduler::Summary summary;
  scheduler::HistogramCounts counts;
};

// Returns a complete SVG document for browsers and for documents that include pictures.
std::string histogram_svg(const std::string& heading, std::span<const HistogramPanel> panels);

}  // namespace indurop::tools
