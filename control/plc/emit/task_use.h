// SPDX-License-Identifier: Apache-2.0
// The parts of the program that a task needs, and the shared local variables of its programs and instances.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

// A shared variable of a program or instance: RETAIN, AT %I* in a function block, or on request all variables of
// programs.
struct SharedLocal {
  std::string cpp;          // "instance_main.c.n"
  std::string name;         // "main_c_n"
  std::string shared_name;  // "main::main_c_n"
  const Type* type = nullptr;
  const ast::Initial* initial = nullptr;
  bool retain = false;
  bool input = false;   // AT %I*: the program does not write it
  std::string comment;  // including its address
  Place at;
};

// A shared variable that follows another variable: VAR_ACCESS.
struct SharedAccess {
  std::string cpp;          // the followed variable: "instance_main.c.n"
  std::string name;         // "pressure"
  std::string shared_name;  // "main::pressure"
  const AccessPath* path = nullptr;
};

struct TaskUse {
  std::vector<const Pou*> pous;  // each after those it uses
  std::map<const Global*, GlobalUse> globals;
  std::vector<SharedLocal> locals;
  std::vector<SharedAccess> accesses;
  std::vector<std::string> restored;  // C++ statements that run after RETAIN values are restored
};

// Returns whether it is copied at the begin of a scan, as shared variables are.
[[nodiscard]] bool in_image(const Global& global) noexcept;

[[nodiscard]] TaskUse use_of(const Program& program, const TaskPlan& task, bool show_locals);

// Returns the C++ name: the task's own variable, or the global instance if other POUs use the program by its name.
[[nodiscard]] std::string instance_of(const TaskProgram& program);

}  // namespace indurop::plc
