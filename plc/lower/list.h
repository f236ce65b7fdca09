// SPDX-License-Identifier: Apache-2.0
// Instruction List to the syntax tree. The accumulator is no variable: what was loaded and computed is an expression
// until it is stored, and kept in a variable of the scan (_il1, ...) where it is used afterwards.

#pragma once

#include <string>

#include "plc/lower/lowered.h"
#include "plc/model/diagnostics.h"
#include "plc/st/parser.h"

namespace indurop::plc::lower {

// The value is what is in the accumulator at the end. `prefix`: of the names of variables, different for each body of a
// POU.
[[nodiscard]] Lowered lower_list(const st::Text& text, const std::string& prefix, Diagnostics& diagnostics);

}  // namespace indurop::plc::lower
