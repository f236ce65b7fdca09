// SPDX-License-Identifier: Apache-2.0
// The part of a module built with --watch that tells the values of its programs.

#pragma once

#include <string>
#include <vector>

#include "plc/check/program.h"
#include "plc/emit/debug_table.h"
#include "plc/emit/text_writer.h"

namespace indurop::plc {

// "show(out, instance)" for each of the POUs that has instances; in namespace plc.
void emit_watched(const std::vector<const Pou*>& pous, TextWriter& out);
// The frame of a body that a debugger sees; where the variables of the call are known. Takes its number from `table`.
void emit_frame(const Pou& pou, DebugTable& table, TextWriter& out);
// "debug_globals(out)" of these.
void emit_globals(const std::vector<const Global*>& globals, DebugTable& table, TextWriter& out);
// "watch()" for the instances of the task, named as in the module; `space`: of the shared variables.
void emit_watch(const TaskPlan& task, const std::string& space, TextWriter& out);

}  // namespace indurop::plc
