// SPDX-License-Identifier: Apache-2.0
// Variables that end with the call: those of functions and methods, and VAR_TEMP.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Returns whether the variable still exists after the body that names it has run. False for references and VAR_IN_OUT:
// they refer to variables of the caller, whose lifetime is not known.
[[nodiscard]] bool outlasts_call(const ast::Expression& expression);
// Returns whether it is a variable of this call, or a part of one.
[[nodiscard]] bool ends_with_call(const ast::Expression& expression);

// Checks p := ADR(x), where p outlives x: a warning. For interfaces it is an error, because unlike pointers they do not
// notice it when they are used.
void check_lifetime(Context& context, const ast::Statement& one);

}  // namespace indurop::plc
