// SPDX-License-Identifier: Apache-2.0
// VAR_CONFIG: addresses and initial values that a configuration gives to variables of instances.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Writes them into the declarations. Requires that all types are declared, and no variables of POUs yet.
void apply_configured(Context& context);

}  // namespace indurop::plc
