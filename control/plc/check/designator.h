// SPDX-License-Identifier: Apache-2.0
// Finds the variable that an expression such as x.a[3].b designates.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Returns true for an expression that can be left of := : a name, with members, indices and bits of it.
[[nodiscard]] bool is_designator(const ast::Expression& expression) noexcept;
// Returns the variable at the root of x.a[3].b: x.
[[nodiscard]] const ast::Expression& root_of(const ast::Expression& expression) noexcept;
// Returns p of p^.x and p[3].x; null if the value is not reached through a pointer.
[[nodiscard]] const ast::Expression* through_pointer(const ast::Expression& expression) noexcept;

}  // namespace indurop::plc
