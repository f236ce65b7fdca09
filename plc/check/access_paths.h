// SPDX-License-Identifier: Apache-2.0
// Variables that are named from outside of POUs: by VAR_ACCESS, and where a configuration connects a program's inputs
// and outputs with global variables.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Finds what VAR_ACCESS and the connections of programs name. Call when the variables of all POUs are declared, before
// their bodies are checked: what is reached from outside counts as used.
void resolve_accesses(Context& context);

}  // namespace indurop::plc
