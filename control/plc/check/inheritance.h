// SPDX-License-Identifier: Apache-2.0
// The inheritance between POUs, without circles and with limited depth.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Fills `ancestors` of all function blocks, classes and interfaces. One that extends itself, directly or not, or has
// more ancestors than later passes can handle, is reported and extends nothing afterwards.
void resolve_inheritance(Context& context);

}  // namespace indurop::plc
