// SPDX-License-Identifier: Apache-2.0
// Who inherits from whom, without circles and not too deep.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Fills `ancestors` of all function blocks, classes and interfaces. One that extends itself at any distance, or has
// more ancestors than the passes behind this one bear, extends nothing afterwards, with an error.
void resolve_inheritance(Context& context);

}  // namespace indurop::plc
