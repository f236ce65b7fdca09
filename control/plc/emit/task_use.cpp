// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/task_use.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "control/plc/check/reach.h"
#include "control/plc/emit/access_emitter.h"
#include "control/plc/emit/cpp_text.h"
#include "control/plc/emit/shared_locals.h"

namespace indurop::plc {

std::string instance_of(const TaskProgram& program) {
  return program.pou->instance != nullptr ? "plc::" + cpp_name(*program.pou->instance) : "instance_" + program.instance;
}

bool in_image(const Global& global) noexcept {
  return global.kind == Global::Kind::Own || global.kind == Global::Kind::Foreign;
}

TaskUse use_of(const Program& program, const TaskPlan& task, bool show_locals) {
  TaskUse out;
  const std::set<const Pou*> found = reached_by(task);
  std::copy_if(program.order.begin(), program.order.end(), std::back_inserter(out.pous),
               [&](const Pou* pou) { return found.contains(pou); });
  for (const Pou* pou : out.pous) {
    for (const auto& [global, use] : pou->globals) {
      GlobalUse& sum = out.globals[global];
      sum.read = sum.read || use.read;
      sum.writes.insert(use.writes.begin(), use.writes.end());
    }
  }
  for (const TaskProgram& one : task.programs) {
    if (one.pou->instance != nullptr) {
      out.globals[one.pou->instance].read = true;
    }
  }
  find_shared_locals(program, task, show_locals, out);
  find_accesses(program, task, out);
  return out;
}

}  // namespace indurop::plc
