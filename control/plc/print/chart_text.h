// SPDX-License-Identifier: Apache-2.0
// Prints a sequential function chart as a list: steps with their actions, and the transitions that leave them.

#pragma once

#include <functional>
#include <string>

#include "control/plc/network/chart.h"

namespace indurop::plc {

// Texts after a step and a condition: for a running program whether the step is active, and values.
struct ChartMarks {
  std::function<std::string(const network::Step& step)> step;
  std::function<std::string(const std::string& text)> condition;
};
[[nodiscard]] std::string chart_text(const network::Chart& chart, bool unicode, const ChartMarks& marks = {});

// Returns the name of an action, or its code in one line.
[[nodiscard]] std::string action_text(const network::ActionLine& line);

// Returns the text at a transition: its condition, or its name.
[[nodiscard]] std::string condition_text(const network::Element& transition);

}  // namespace indurop::plc
