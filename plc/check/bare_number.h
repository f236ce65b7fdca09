// SPDX-License-Identifier: Apache-2.0
// Expressions of numbers without a type: 807 * MAX(-1, 154). What stands beside them says what they are.

#pragma once

#include "plc/check/program.h"

namespace indurop::plc {

// Numbers without a type, operators between them, and library functions that give the type they are given.
[[nodiscard]] bool is_bare(const ast::Expression& expression, const Program& program);

// Whether its value may be another than those of its numbers: not so of MAX(1, 2).
[[nodiscard]] bool computes(const ast::Expression& bare);

// The type that holds what becomes of such an expression where nothing beside it says one: LINT, or LREAL if there is a
// number with a point in it.
[[nodiscard]] Elementary widest_of(const ast::Expression& bare, const Program& program);

}  // namespace indurop::plc
