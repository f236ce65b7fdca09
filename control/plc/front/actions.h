// SPDX-License-Identifier: Apache-2.0
// Actions that other POUs call, x.Restart(), as in CODESYS.

#pragma once

#include "control/plc/model/project.h"

namespace indurop::plc {

// Turns those actions into methods that a call after a dot can refer to.
void make_methods_of_actions(Project& project);

}  // namespace indurop::plc
