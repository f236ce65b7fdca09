// SPDX-License-Identifier: Apache-2.0
// A sequential function chart to statements. Each scan: all transitions are evaluated with the steps as they are, those
// that are true are cleared together, then the actions run. The first scan runs the actions of the initial step.

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plc/lower/lowered.h"
#include "plc/model/diagnostics.h"
#include "plc/model/project.h"
#include "plc/network/chart.h"

namespace indurop::plc::lower {

using network::Association;
using network::Chart;
using network::Step;
using network::Transition;

// The type of the variable that each step is: X, T.
inline constexpr const char* kStepType = "SFC_STEP";
// That of the standard, whatever the program calls TON.
inline constexpr const char* kTimerType = "@TON";
[[nodiscard]] ast::TypeDeclaration step_type();
// Whether the body or an action is a chart, so that the type is needed.
[[nodiscard]] bool has_chart(const network::PouCode& code);

// What a chart finds in its POU.
struct ChartSurroundings {
  // The code of an action of this name; null if there is none: the name is that of a variable.
  std::function<network::Body*(const std::string&)> action;
  std::function<network::Body*(const std::string&)> transition;
  // Whether the POU has a variable of this name.
  std::function<bool(const std::string&)> declared;
  // Whether it is the action of an instance, Valve.Open.
  std::function<bool(const std::string&)> foreign_action;
  // `prefix` makes the names of variables different from those of other bodies.
  std::function<Lowered(network::Body&, const std::string& prefix)> action_code;
  std::function<Lowered(network::Body&, const std::string& name, const std::string& prefix)> condition_code;
  // The value at a line drawn to a transition.
  std::function<ast::Expression(const network::Element& transition)> drawn_condition;
};

[[nodiscard]] Lowered lower_chart(const Chart& chart, const ChartSurroundings& around, Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
