// SPDX-License-Identifier: Apache-2.0
// The translation of code of any language to the common syntax tree.

#pragma once

#include <optional>
#include <vector>

#include "control/plc/model/ast.h"

namespace indurop::plc {

struct Lowered {
  ast::Body body;
  std::vector<ast::Variable> variables;  // to add to the POU
  std::optional<ast::Expression> value;  // of a condition, or the accumulator at the end
};

}  // namespace indurop::plc
