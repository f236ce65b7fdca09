// SPDX-License-Identifier: Apache-2.0
// Declarations and bodies of POUs, and in which order they can be defined.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Names of all POUs, before anything that refers to them.
void declare_pous(Context& context);
// Variables of all POUs.
void declare_variables(Context& context);
void check_bodies(Context& context);
// Fills Program::order; a POU that needs itself is an error.
void order_pous(Context& context);

// One more function, which a call asks for: its body is checked after those before it.
Pou& declare_further(Context& context, ast::Pou& tree);
// One more method.
void declare_method(Context& context, Pou& owner, ast::Pou& tree);

}  // namespace indurop::plc
