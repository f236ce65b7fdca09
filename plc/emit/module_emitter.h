// SPDX-License-Identifier: Apache-2.0
// The C++ module of one task.

#pragma once

#include <string>

#include "plc/check/program.h"
#include "plc/emit/probes.h"

namespace indurop::plc {

struct ModuleOptions {
  std::string name;          // of the module
  std::string sources;       // "prog.st, more.st", for the comment
  bool show_locals = false;  // variables of programs are shared variables too
  bool watch = false;        // tells a running view about all variables
  Probes probes;             // what its bodies tell a debugger, or count
};

[[nodiscard]] std::string emit_module(const Program& program, const TaskPlan& task, const ModuleOptions& options);

}  // namespace indurop::plc
