// SPDX-License-Identifier: Apache-2.0
// Makes a program tell a running view about the power in its networks: shared variables that it writes once per scan.

#pragma once

#include <string>

#include "plc/lower/networks.h"
#include "plc/model/project.h"

namespace indurop::plc::lower {

// "main_flow": an array of bytes, a bit per point in their order that is BOOL.
[[nodiscard]] std::string flow_variable(const std::string& pou);
// "main_value_12_ET": an output of an instance that is no BOOL.
[[nodiscard]] std::string value_variable(const std::string& pou, const Source& source);

// Declares the variables and writes them behind `lowered.body`.
void add_flow(LoweredNetworks& lowered, const ast::Pou& pou, std::vector<ast::Variable>& globals);

}  // namespace indurop::plc::lower
