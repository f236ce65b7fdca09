// SPDX-License-Identifier: Apache-2.0
// Emits the C++ module of one task.

#pragma once

#include <string>

#include "control/plc/check/program.h"
#include "control/plc/emit/probes.h"

namespace indurop::plc {

struct ModuleOptions {
  std::string name;          // of the module
  std::string sources;       // "prog.st, more.st", for the comment
  bool show_locals = false;  // variables of programs are shared variables too
  bool watch = false;        // reports all variables to a running view
  Probes probes;             // instrumentation of its bodies for a debugger or coverage
};

[[nodiscard]] std::string emit_module(const Program& program, const TaskPlan& task, const ModuleOptions& options);

}  // namespace indurop::plc
