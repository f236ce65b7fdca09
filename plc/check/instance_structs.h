// SPDX-License-Identifier: Apache-2.0
// STRUCTs that contain function blocks, as CODESYS and TwinCAT have them.

#pragma once

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"

namespace indurop::plc {

// Makes a class without methods of each: what holds instances is one itself, has no value and is not shared.
void make_instance_structs(Project& project, Diagnostics& diagnostics);

}  // namespace indurop::plc
