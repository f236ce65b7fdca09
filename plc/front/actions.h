// SPDX-License-Identifier: Apache-2.0
// Actions that others call, x.Restart(), as CODESYS has it.

#pragma once

#include "plc/model/project.h"

namespace indurop::plc {

// Makes methods of those actions that a call behind a dot may mean.
void make_methods_of_actions(Project& project);

}  // namespace indurop::plc
