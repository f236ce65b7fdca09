// SPDX-License-Identifier: Apache-2.0
#include "plc/emit/task_use.h"

#include <algorithm>
#include <set>

#include "plc/check/reach.h"
#include "plc/check/shared_names.h"

namespace indurop::plc {
namespace {

// Made by the translation of a drawn program.
bool is_hidden(const Variable& variable) {
  return variable.name.starts_with('_');
}

bool is_shown(const Variable& variable, bool show_locals) {
  const bool kept = variable.section == ast::Section::Local || variable.section == ast::Section::Input ||
                    variable.section == ast::Section::Output;
  return kept && variable.global == nullptr && !variable.is_constant &&
         (variable.retain || (show_locals && !is_hidden(variable))) && !is_private(*variable.type);
}

}  // namespace

TaskUse use_of(const Program& program, const TaskPlan& task, bool show_locals) {
  TaskUse out;
  const std::set<const Pou*> found = reached_by(task);
  for (const TaskProgram& one : task.programs) {
    for (const Variable& variable : one.pou->variables) {
      if (is_shown(variable, show_locals)) {
        out.locals.push_back(
            {one.instance, &variable, program.space + "::" + name_of_shared(one.instance + "_" + variable.name)});
      }
    }
  }
  std::copy_if(program.order.begin(), program.order.end(), std::back_inserter(out.pous),
               [&](const Pou* pou) { return found.contains(pou); });
  for (const Pou* pou : out.pous) {
    for (const auto& [global, use] : pou->globals) {
      GlobalUse& sum = out.globals[global];
      sum.read = sum.read || use.read;
      sum.writes.insert(use.writes.begin(), use.writes.end());
    }
  }
  return out;
}

}  // namespace indurop::plc
