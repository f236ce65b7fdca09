// SPDX-License-Identifier: Apache-2.0
// A sequential function chart as steps, transitions between them and actions, derived from the drawn divergences,
// convergences and jumps.

#pragma once

#include <string>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/network/networks.h"

namespace indurop::plc::network {

struct Step {
  const Element* element = nullptr;
  std::string name;
  bool initial = false;
};

// Indices of steps.
struct Transition {
  const Element* element = nullptr;
  std::vector<std::size_t> from;  // all must be active
  std::vector<std::size_t> to;
};

// A line of an action block.
struct Association {
  std::size_t step = 0;
  const ActionLine* line = nullptr;
};

struct Chart {
  std::vector<Step> steps;
  std::vector<Transition> transitions;  // of those that leave one step the first true one is taken
  std::vector<Association> actions;     // in drawing order
};

// The result refers to the diagram. Errors are reported at the places of its elements.
[[nodiscard]] Chart read_chart(const Diagram& diagram, Diagnostics& diagnostics);

}  // namespace indurop::plc::network
