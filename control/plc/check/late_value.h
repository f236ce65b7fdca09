// SPDX-License-Identifier: Apache-2.0
// Initial values that are known late: p : POINTER TO INT := ADR(x) only at run time, those of instances only after all
// variables of function blocks are known.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Moves such a value from the declaration to ast::Variable::late.
void set_late_value(const Context& context, ast::Variable& declared, const Type& type, const Pou& pou);

// Checks the values of Context::open_initials.
void check_open_initials(Context& context);

}  // namespace indurop::plc
