// SPDX-License-Identifier: Apache-2.0
// Which variables are gone when the call is over: those of functions and methods, and VAR_TEMP.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Whether the variable is still there when the body that names it has run. What references and VAR_IN_OUT stand for is
// the caller's: not known, so no.
[[nodiscard]] bool outlasts_call(const ast::Expression& expression);
// Whether it is a variable of this call itself, or lies in one.
[[nodiscard]] bool ends_with_call(const ast::Expression& expression);

// p := ADR(x), where p is still there when x is gone: a warning. Pointers know it when they are used, interfaces do
// not: an error.
void look_at_lifetime(Context& context, const ast::Statement& one);

}  // namespace indurop::plc
