// SPDX-License-Identifier: Apache-2.0
// Makes a body keep the power in its networks: a hidden variable of its POU that it writes once per call.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plc/lower/networks.h"

namespace indurop::plc::lower {

// "_flow" of a POU's own body, "_flow_Open" of its action: a BOOL per point that is no value, in their order.
[[nodiscard]] std::string flow_variable(const std::string& action);
[[nodiscard]] bool is_flow(std::string_view variable);

// Gives each point its number in that variable; how many there are.
std::size_t number_points(std::vector<FlowPoint>& flow);

// Writes it behind `lowered.body`. `declare`: the first time; what several steps run is there several times.
void add_flow(LoweredNetworks& lowered, const std::string& variable, const Place& at, bool declare);

}  // namespace indurop::plc::lower
