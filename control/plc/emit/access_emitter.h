// SPDX-License-Identifier: Apache-2.0
// Emits code for variables that are reached from outside of POUs: VAR_ACCESS, and connections of programs.

#pragma once

#include "control/plc/emit/task_use.h"
#include "control/plc/emit/text_writer.h"

namespace indurop::plc {

// Returns "instance_main.motor.speed"; the instance is looked up in `task` if the path leads to a program.
[[nodiscard]] std::string cpp_of(const Reached& reached, const TaskPlan& task);
// Adds the access paths of the task, and the globals they lead to, to `use`.
void find_accesses(const Program& program, const TaskPlan& task, TaskUse& use);
// Emits the memory of the access paths, which is outside of functions.
void declare_accesses(const TaskUse& use, TextWriter& out);
// Emits the reading of access paths: after shared variables are copied in at the begin of a scan, and before they are
// copied out at its end.
void read_accesses(const TaskUse& use, TextWriter& out);
void write_accesses(const TaskUse& use, TextWriter& out);
// Emits the call of a program with the values of its connections.
void call_program(const Program& program, const TaskPlan& task, const TaskProgram& one, TextWriter& out);

}  // namespace indurop::plc
