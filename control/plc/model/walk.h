// SPDX-License-Identifier: Apache-2.0
// Visits all expressions of a tree, the outer ones first.

#pragma once

#include <functional>
#include <string>

#include "control/plc/model/ast.h"

namespace indurop::plc::ast {

using Visit = std::function<void(Expression&)>;

// Visits the expression itself, then its operands as the visit left them.
void each_expression(Expression& expression, const Visit& visit);
void each_expression(Statement& statement, const Visit& visit);
void each_expression(Body& body, const Visit& visit);
void each_expression(Initial& initial, const Visit& visit);

// Returns "A.B" for a chain of names, "" for anything else.
[[nodiscard]] std::string path_of(const Expression& expression);

// Returns the nesting of operators, calls and indices.
[[nodiscard]] std::size_t depth_of(const Expression& expression);

}  // namespace indurop::plc::ast
