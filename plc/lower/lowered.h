// SPDX-License-Identifier: Apache-2.0
// Code of any language as the one syntax tree has it.

#pragma once

#include <optional>
#include <vector>

#include "plc/model/ast.h"

namespace indurop::plc {

struct Lowered {
  ast::Body body;
  std::vector<ast::Variable> variables;  // to add to the POU
  std::optional<ast::Expression> value;  // of a condition: what it is, or what is in the accumulator at the end
};

}  // namespace indurop::plc
