// SPDX-License-Identifier: Apache-2.0
// Translates a sequential function chart to statements. In each scan all transitions are evaluated with the steps as
// they are at its beginning, those that are true are cleared together, then the actions run. The first scan runs the
// actions of the initial step.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "control/plc/lower/lowered.h"
#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/network/chart.h"

namespace indurop::plc::lower {

using network::Association;
using network::Chart;
using network::Step;
using network::Transition;

// The type of the variable of each step: X, T.
inline constexpr const char* kStepType = "SFC_STEP";
// The TON of the standard, even if the program declares another one.
inline constexpr const char* kTimerType = "@TON";
[[nodiscard]] ast::TypeDeclaration step_type();
// Returns whether the body or an action is a chart, so that the type is needed.
[[nodiscard]] bool has_chart(const network::PouCode& code);

// The items of its POU that a chart uses.
struct ChartSurroundings {
  // Returns the code of an action of this name; null if there is none: the name is that of a variable.
  std::function<network::Body*(const std::string&)> action;
  std::function<network::Body*(const std::string&)> transition;
  // Returns whether the POU has a variable of this name.
  std::function<bool(const std::string&)> declared;
  // Returns whether it is the action of an instance, Valve.Open.
  std::function<bool(const std::string&)> foreign_action;
  // Translates the code of an action. `prefix` makes the names of its variables different from those of other bodies.
  std::function<Lowered(network::Body&, const std::string& prefix)> action_code;
  std::function<Lowered(network::Body&, const std::string& name, const std::string& prefix)> condition_code;
  // Returns the value at a line drawn to a transition.
  std::function<ast::Expression(const network::Element& transition)> drawn_condition;
};

[[nodiscard]] Lowered lower_chart(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
