// SPDX-License-Identifier: Apache-2.0
// The assignment of programs to tasks.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

// Fills Program::tasks. Without a configuration all programs run in one task of the default interval.
void plan_tasks(Context& context);

}  // namespace indurop::plc
