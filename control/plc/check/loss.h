// SPDX-License-Identifier: Apache-2.0
// Assignments that lose data without an error: the end of a text, and digits of whole numbers lost before the
// conversion to a larger type, because the type of an expression is that of its operands, not of the target.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Warns of s := 'too long'; of x := i / 2 into REAL; of d := n * 30000 of INT into DINT. `type`: the type of the
// expression without its context.
void warn_of_loss(Context& context, const ast::Expression& expression, const Type& type, const Type& to);

}  // namespace indurop::plc
