// SPDX-License-Identifier: Apache-2.0
// Instruction List to the syntax tree. The accumulator is no variable: what was loaded and computed is an expression
// until it is stored, and kept in a variable of the scan (_il1, ...) where it is used afterwards.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plc/model/diagnostics.h"
#include "plc/st/parser.h"

namespace indurop::plc::il {

struct Lowered {
  ast::Body body;
  std::vector<ast::Variable> variables;  // to add to the POU
  std::optional<ast::Expression> value;  // in the accumulator at the end
};

// `prefix`: of the names of variables, different for each body of a POU.
[[nodiscard]] Lowered lower(const st::Text& text, const std::string& prefix, Diagnostics& diagnostics);

}  // namespace indurop::plc::il
