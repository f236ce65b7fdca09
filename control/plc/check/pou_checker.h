// SPDX-License-Identifier: Apache-2.0
// Declarations and bodies of POUs, and in which order they can be defined.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Declares the names of all POUs. Call it before anything that refers to them.
void declare_pous(Context& context);
// Declares the variables of all POUs.
void declare_variables(Context& context);
void check_bodies(Context& context);
// Fills Program::order; reports a POU that needs itself as an error.
void order_pous(Context& context);

// Declares an additional function that a call requires: its body is checked after those before it.
Pou& declare_further(Context& context, ast::Pou& tree);
// Declares an additional method.
void declare_method(Context& context, Pou& owner, ast::Pou& tree);

}  // namespace indurop::plc
