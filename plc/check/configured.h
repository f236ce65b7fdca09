// SPDX-License-Identifier: Apache-2.0
// VAR_CONFIG: places and initial values that variables of instances get in the configuration.

#pragma once

#include "plc/check/context.h"

namespace indurop::plc {

// Writes them into the declarations. Requires all types, and that no variables of POUs are declared yet.
void apply_configured(Context& context);

}  // namespace indurop::plc
