// SPDX-License-Identifier: Apache-2.0
// Variables that are named from outside of POUs: by VAR_ACCESS, and where a configuration connects the inputs and
// outputs of a program with global variables.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Resolves the paths of VAR_ACCESS and of the connections of programs. Call it after the variables of all POUs are
// declared and before their bodies are checked: a variable reached from outside counts as used.
void resolve_accesses(Context& context);

}  // namespace indurop::plc
