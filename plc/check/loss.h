// SPDX-License-Identifier: Apache-2.0
// What an assignment loses without an error: the end of a text, and what whole numbers lost before they became more, as
// the type of an expression is that of its operands, whatever it is assigned to.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// s := 'too long'; x := i / 2 into REAL; d := n * 30000 of INT into DINT: warnings. `type`: of the expression by
// itself.
void warn_of_loss(Context& context, const ast::Expression& expression, const Type& type, const Type& to);

}  // namespace indurop::plc
