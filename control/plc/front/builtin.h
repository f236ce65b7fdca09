// SPDX-License-Identifier: Apache-2.0
// Types and function blocks that are built into editors and therefore missing in their files: LOGGER of Beremiz, the
// types of its SVGHMI.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"

namespace indurop::plc {

// Declares those that the project uses and does not declare.
void add_builtin(Project& project);

}  // namespace indurop::plc
