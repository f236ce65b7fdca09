// SPDX-License-Identifier: Apache-2.0
// Goes through all expressions of a tree, the outer ones first.

#pragma once

#include <functional>
#include <string>

#include "plc/model/ast.h"

namespace indurop::plc::ast {

using Visit = std::function<void(Expression&)>;

// The expression itself, then what is in it, as the visit left it.
void each_expression(Expression& expression, const Visit& visit);
void each_expression(Statement& statement, const Visit& visit);
void each_expression(Body& body, const Visit& visit);
void each_expression(Initial& initial, const Visit& visit);

// "A.B" of names behind each other, "" of anything else.
[[nodiscard]] std::string path_of(const Expression& expression);

// Operators, calls and indices inside each other.
[[nodiscard]] std::size_t depth_of(const Expression& expression);

}  // namespace indurop::plc::ast
