// SPDX-License-Identifier: Apache-2.0
// What a task needs of the whole program, and which local variables of its programs are shared too.

#pragma once

#include <map>
#include <string>
#include <vector>

#include "plc/check/program.h"

namespace indurop::plc {

// A variable of a program that everybody can see: RETAIN, or all of them on request.
struct SharedLocal {
  std::string instance;
  const Variable* variable = nullptr;
  std::string shared_name;  // "main::MAIN_counter"
};

struct TaskUse {
  std::vector<const Pou*> pous;  // each behind those it uses
  std::map<const Global*, GlobalUse> globals;
  std::vector<SharedLocal> locals;
};

[[nodiscard]] TaskUse use_of(const Program& program, const TaskPlan& task, bool show_locals);

}  // namespace indurop::plc
