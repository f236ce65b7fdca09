// SPDX-License-Identifier: Apache-2.0
// Translates Instruction List to the syntax tree. The accumulator is not a variable: the loaded and computed value is
// an expression until it is stored, and is stored in a variable of the scan (_il1, ...) where it is used afterwards.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "control/plc/lower/lowered.h"
#include "control/plc/model/diagnostics.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::lower {

// Returns whether the POU has a variable of this name that is a function block with this input.
using HasInput = std::function<bool(std::string_view instance, std::string_view input)>;

enum class ListUse : std::uint8_t { Statements, Condition };

// The value of a condition is the content of the accumulator at the end. `prefix` begins the names of variables,
// different for each body of a POU.
[[nodiscard]] Lowered lower_list(const st::Text& text, const std::string& prefix, const HasInput& has_input,
                                 ListUse use, Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
