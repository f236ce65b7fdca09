// SPDX-License-Identifier: Apache-2.0
// A sequential function chart as a list: steps with their actions, and the transitions that leave them.

#pragma once

#include <string>

#include "plc/network/chart.h"

namespace indurop::plc {

[[nodiscard]] std::string chart_text(const network::Chart& chart, bool unicode);

// The name of an action, or its code in one line.
[[nodiscard]] std::string action_text(const network::ActionLine& line);

// What is written at a transition: its condition, or its name.
[[nodiscard]] std::string condition_text(const network::Element& transition);

}  // namespace indurop::plc
