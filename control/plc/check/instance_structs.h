// SPDX-License-Identifier: Apache-2.0
// STRUCTs that contain function blocks, as in CODESYS and TwinCAT.

#pragma once

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"

namespace indurop::plc {

// Turns each into a class without methods: a type that holds instances is an instance itself, has no value and is not
// shared.
void make_instance_structs(Project& project, Diagnostics& diagnostics);

}  // namespace indurop::plc
