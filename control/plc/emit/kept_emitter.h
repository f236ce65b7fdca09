// SPDX-License-Identifier: Apache-2.0
// Emits the description of what a module keeps between its scans: its variables by name and type.

#pragma once

#include <string>
#include <vector>

#include "control/plc/emit/task_use.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

// `own`: names of variables of the module itself that say what it did already; each a bool.
void emit_kept(const TaskPlan& task, const TaskUse& use, const std::vector<const Global*>& globals,
               const std::vector<std::string>& own, TextWriter& out);

}  // namespace indurop::plc
