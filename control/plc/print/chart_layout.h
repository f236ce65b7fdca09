// SPDX-License-Identifier: Apache-2.0
// Positions of the steps and transitions of a chart on a sheet: rows from top to bottom, a column for each branch.
// Independent of how they look.

#pragma once

#include <cstddef>
#include <vector>

#include "control/plc/network/chart.h"

namespace indurop::plc {

struct ChartSpot {
  std::size_t row = 0;  // steps and transitions alternate
  std::size_t column = 0;
};

struct ChartLayout {
  std::vector<ChartSpot> steps;          // same order as in the chart
  std::vector<ChartSpot> transitions;    // same order as in the chart
  std::vector<std::vector<bool>> jumps;  // per transition and step: upwards, or not reachable by a line
  std::size_t rows = 0;
  std::size_t columns = 0;
};

// Lines that are not jumps lead from each transition to each of its steps without crossing another node.
[[nodiscard]] ChartLayout lay_out_chart(const network::Chart& chart);

}  // namespace indurop::plc
