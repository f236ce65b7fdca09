// SPDX-License-Identifier: Apache-2.0
// Initial values that only the running program knows: p : POINTER TO INT := ADR(x).

#pragma once

#include "plc/check/program.h"

namespace indurop::plc {

// Takes such a value out of the declaration, into ast::Variable::late.
void set_late_value(ast::Variable& declared, const Type& type, const Pou& pou);

}  // namespace indurop::plc
