// SPDX-License-Identifier: Apache-2.0
// Constants may be declared before those they are computed from.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"

namespace indurop::plc {

// Moves constants that others need to the front; all else keeps its order. Circles are errors.
void order_constants(Project& project, Diagnostics& diagnostics);

}  // namespace indurop::plc
