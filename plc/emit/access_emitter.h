// SPDX-License-Identifier: Apache-2.0
// Statements for what is reached from outside of POUs: VAR_ACCESS, and connections of programs.

#pragma once

#include "plc/emit/task_use.h"
#include "plc/emit/text_writer.h"

namespace indurop::plc {

// "instance_main.motor.speed"; the instance is asked for where the path leads to a program.
[[nodiscard]] std::string cpp_of(const Reached& reached, const TaskPlan& task);
// Puts what lies behind access paths of the task into its use of globals, and the paths in.
void find_accesses(const Program& program, const TaskPlan& task, TaskUse& use);
// The memory of the access paths, which stands outside of functions.
void declare_accesses(const TaskUse& use, TextWriter& out);
// Behind the copying of shared variables at the begin of a scan, and before that at its end.
void read_accesses(const TaskUse& use, TextWriter& out);
void write_accesses(const TaskUse& use, TextWriter& out);
// The call of a program, with what its connections give and take.
void call_program(const Program& program, const TaskPlan& task, const TaskProgram& one, TextWriter& out);

}  // namespace indurop::plc
