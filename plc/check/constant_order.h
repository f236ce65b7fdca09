// SPDX-License-Identifier: Apache-2.0
// Constants may stand before those they are computed from.

#pragma once

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"

namespace indurop::plc {

// Those that others need come first; everything else keeps its order. Circles are errors.
void order_constants(Project& project, Diagnostics& diagnostics);

}  // namespace indurop::plc
