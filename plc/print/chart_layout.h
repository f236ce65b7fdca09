// SPDX-License-Identifier: Apache-2.0
// Where the steps and transitions of a chart stand on a sheet: rows from top to bottom, a column for each branch. Knows
// nothing of how they look.

#pragma once

#include <cstddef>
#include <vector>

#include "plc/network/chart.h"

namespace indurop::plc {

struct ChartSpot {
  std::size_t row = 0;  // steps and transitions alternate
  std::size_t column = 0;
};

struct ChartLayout {
  std::vector<ChartSpot> steps;          // as in the chart
  std::vector<ChartSpot> transitions;    // as in the chart
  std::vector<std::vector<bool>> jumps;  // of transition i to its k-th step: upwards, or to where a line cannot lead
  std::size_t rows = 0;
  std::size_t columns = 0;
};

// A line may lead from each transition to each step that is no jump without crossing another node.
[[nodiscard]] ChartLayout lay_out_chart(const network::Chart& chart);

}  // namespace indurop::plc
