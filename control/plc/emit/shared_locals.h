// SPDX-License-Identifier: Apache-2.0
// Finds the local variables that are shared, including those inside instances of function blocks.

#pragma once

#include "control/plc/emit/task_use.h"

namespace indurop::plc {

// Appends them to `use`, whose globals must be set.
void find_shared_locals(const Program& program, const TaskPlan& task, bool show_locals, TaskUse& use);

}  // namespace indurop::plc
