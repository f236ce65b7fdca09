// SPDX-License-Identifier: Apache-2.0
// Translates the actions of a chart according to their qualifiers.

#pragma once

#include "control/plc/lower/chart.h"

namespace indurop::plc::lower {

// Returns statements that run the actions of the steps that are active now:
//   N while active; L at most for a time; D after a time; P, P1 once on entry; P0 once on exit;
//   S from now on, SD after a time, SL for a time, DS once active for a time; R ends what S began.
// A variable is TRUE while its action is on. Code runs in each scan while it is on and once after it; pulses run once.
[[nodiscard]] Lowered lower_actions(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics);

// Returns Step.X.
[[nodiscard]] ast::Expression active(const Chart& chart, std::size_t step, const Place& at);
// Returns the variable that tells whether the step was active in the previous scan.
[[nodiscard]] std::string step_before(std::size_t step);

}  // namespace indurop::plc::lower
