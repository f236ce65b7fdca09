// SPDX-License-Identifier: Apache-2.0
// Initial values that are known late: p : POINTER TO INT := ADR(x) when the program runs, those of instances when all
// variables of function blocks are known.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Takes such a value out of the declaration, into ast::Variable::late.
void set_late_value(const Context& context, ast::Variable& declared, const Type& type, const Pou& pou);

// Looks at those of Context::open_initials.
void check_open_initials(Context& context);

}  // namespace indurop::plc
