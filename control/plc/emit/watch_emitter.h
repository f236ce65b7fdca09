// SPDX-License-Identifier: Apache-2.0
// Emits the part of a module built with --watch that reports the values of its programs.

#pragma once

#include <string>
#include <vector>

#include "control/plc/check/program.h"
#include "control/plc/emit/debug_table.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

// Emits "show(out, instance)" for each of the POUs that has instances; in namespace plc.
void emit_watched(const std::vector<const Pou*>& pous, TextWriter& out);
// Emits the frame of a body for a debugger, at a point where the variables of the call are known. Takes its number from
// `table`.
void emit_frame(const Pou& pou, DebugTable& table, TextWriter& out);
// Emits "debug_globals(out)" for these globals.
void emit_globals(const std::vector<const Global*>& globals, DebugTable& table, TextWriter& out);
// Emits "watch()" for the instances of the task, named as in the module; `space`: namespace of the shared variables.
void emit_watch(const TaskPlan& task, const std::string& space, TextWriter& out);

}  // namespace indurop::plc
