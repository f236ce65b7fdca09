// SPDX-License-Identifier: Apache-2.0
// EN and ENO inside of the bodies of functions, methods and function blocks.

#pragma once

#include "plc/model/project.h"

namespace indurop::plc {

// A body that names ENO gets it as an output that is TRUE when the body begins; EN is TRUE there.
void declare_enable_outputs(Project& project);

}  // namespace indurop::plc
