// SPDX-License-Identifier: Apache-2.0
// A recording as a picture (SVG): a lane for each column of few values, a panel for each of many, one axis of time.

#pragma once

#include <string>

#include "tools/values/recording.h"

namespace indurop::tools {

// `way`: drawn below, as way_svg() does it.
std::string chart_svg(const std::string& heading, const Recording& recording, const Series* way = nullptr);

// Round values between the ends, about as many as wanted.
std::vector<double> round_values(double from, double to, int about);

}  // namespace indurop::tools
