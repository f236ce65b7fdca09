// SPDX-License-Identifier: Apache-2.0
// A sequential function chart as a list: steps with their actions, and the transitions that leave them.

#pragma once

#include <functional>
#include <string>

#include "plc/network/chart.h"

namespace indurop::plc {

// What stands behind a step and a condition: of a running program whether it is active, and values.
struct ChartMarks {
  std::function<std::string(const network::Step& step)> step;
  std::function<std::string(const std::string& text)> condition;
};
[[nodiscard]] std::string chart_text(const network::Chart& chart, bool unicode, const ChartMarks& marks = {});

// The name of an action, or its code in one line.
[[nodiscard]] std::string action_text(const network::ActionLine& line);

// What is written at a transition: its condition, or its name.
[[nodiscard]] std::string condition_text(const network::Element& transition);

}  // namespace indurop::plc
