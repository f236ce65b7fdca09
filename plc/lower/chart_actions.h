// SPDX-License-Identifier: Apache-2.0
// Actions of a chart: what their qualifiers mean.

#pragma once

#include "plc/lower/chart.h"

namespace indurop::plc::lower {

// Statements that run the actions of the steps that are active now:
//   N while active; L at most for a time; D after a time; P, P1 once on entry; P0 once on exit;
//   S from now on, SD after a time, SL for a time, DS once active for a time; R ends what S began.
// A variable is TRUE while its action is on. Code runs in each scan it is on and once more after it, pulses once.
[[nodiscard]] Lowered lower_actions(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics);

// Step.X
[[nodiscard]] ast::Expression active(const Chart& chart, std::size_t step, const Place& at);
// Whether the step was active in the scan before.
[[nodiscard]] std::string step_before(std::size_t step);

}  // namespace indurop::plc::lower
