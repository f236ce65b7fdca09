// SPDX-License-Identifier: Apache-2.0
// Expressions of numbers without a type: 807 * MAX(-1, 154). They take their type from the operands around them.

#pragma once

#include "control/plc/check/program.h"

namespace indurop::plc {

// Returns true for numbers without a type, operators between them, and library functions that return the type of their
// arguments.
[[nodiscard]] bool is_bare(const ast::Expression& expression, const Program& program);

// Returns whether the value of the expression can differ from those of its numbers: false for MAX(1, 2).
[[nodiscard]] bool computes(const ast::Expression& bare);

// Returns the type that holds the result of such an expression where nothing around it gives a type: LINT, or LREAL if
// it contains a number with a point.
[[nodiscard]] Elementary widest_of(const ast::Expression& bare, const Program& program);

}  // namespace indurop::plc
