// SPDX-License-Identifier: Apache-2.0
// Makes a body record the power in its networks: in a hidden variable of its POU that it writes once per call.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/plc/lower/networks.h"

namespace indurop::plc::lower {

// Returns "_flow" for the body of a POU, "_flow_Open" for its action: a BOOL per point that is not a value, in their
// order.
[[nodiscard]] std::string flow_variable(const std::string& action);
[[nodiscard]] bool is_flow(std::string_view variable);

// Gives each point its number in that variable; returns how many there are.
std::size_t number_points(std::vector<FlowPoint>& flow);

// Adds the write of the variable after `lowered.body`. `declare`: true the first time; code that several steps run is
// added several times.
void add_flow(LoweredNetworks& lowered, const std::string& variable, const Place& at, bool declare);

}  // namespace indurop::plc::lower
