// SPDX-License-Identifier: Apache-2.0
// Histograms as a picture (SVG): one panel per module, both axes logarithmic, quantiles marked. Pure functions.

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

// A complete SVG document, readable by browsers and by documents that take pictures.
std::string histogram_svg(const std::string& heading, std::span<const HistogramPanel> panels);

}  // namespace indurop::tools
