// SPDX-License-Identifier: Apache-2.0
// EN and ENO inside of the bodies of functions, methods and function blocks.

#pragma once

#include "control/plc/model/project.h"

namespace indurop::plc {

// Declares ENO as an output, TRUE when the body begins, in each body that names it; EN is TRUE there.
void declare_enable_outputs(Project& project);

}  // namespace indurop::plc
