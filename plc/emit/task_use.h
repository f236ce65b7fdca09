// SPDX-License-Identifier: Apache-2.0
// What a task needs of the whole program, and which local variables of its programs and instances are shared too.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "plc/check/program.h"

namespace indurop::plc {

// A variable of a program or instance that everybody can see: RETAIN, AT %I* in a function block, or all those of
// programs on request.
struct SharedLocal {
  std::string cpp;          // "instance_main.c.n"
  std::string name;         // "main_c_n"
  std::string shared_name;  // "main::main_c_n"
  const Type* type = nullptr;
  const ast::Initial* initial = nullptr;
  bool retain = false;
  bool input = false;   // AT %I*: the program does not write it
  std::string comment;  // with its address
  Place at;
};

// A shared variable that follows another one: VAR_ACCESS.
struct SharedAccess {
  std::string cpp;          // what it follows: "instance_main.c.n"
  std::string name;         // "pressure"
  std::string shared_name;  // "main::pressure"
  const AccessPath* path = nullptr;
};

struct TaskUse {
  std::vector<const Pou*> pous;  // each behind those it uses
  std::map<const Global*, GlobalUse> globals;
  std::vector<SharedLocal> locals;
  std::vector<SharedAccess> accesses;
  std::vector<std::string> restored;  // statements of C++ for when what is RETAIN has come
};

// Whether it is copied at the begin of a scan: a shared variable.
[[nodiscard]] bool in_image(const Global& global) noexcept;

[[nodiscard]] TaskUse use_of(const Program& program, const TaskPlan& task, bool show_locals);

// In C++: the task's own variable, or the global that the program is where others use it by its name.
[[nodiscard]] std::string instance_of(const TaskProgram& program);

}  // namespace indurop::plc
