// SPDX-License-Identifier: Apache-2.0
// Emits the part of a module that copies shared variables: in at the beginning of a scan, out at its end.

#pragma once

#include <vector>

#include "control/plc/emit/task_use.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

// Returns whether shared variables of the type are copied without keeping their previous value.
[[nodiscard]] bool is_copied_by_table(const Type& type) noexcept;
// Emits "read_shared()", "write_shared()" and, if there is something to restore, "restore(scan)".
void emit_exchange(const TaskUse& use, const std::vector<const Global*>& globals, TextWriter& out);

}  // namespace indurop::plc
