// SPDX-License-Identifier: Apache-2.0
// Draws a recording as SVG: a lane for each column of few values, a panel for each of many, and one time axis.

#pragma once

#include <string>

#include "tools/client/recordings/recording.h"

namespace indurop::tools {

// `way`: a path that is drawn below, as by way_svg().
std::string chart_svg(const std::string& heading, const Recording& recording, const Series* way = nullptr);

// Returns round values between the ends, about as many as requested.
std::vector<double> round_values(double from, double to, int about);

}  // namespace indurop::tools
