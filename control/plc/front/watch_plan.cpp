// SPDX-License-Identifier: Apache-2.0
#include "control/plc/front/watch_plan.h"

#include <algorithm>

#include "control/plc/front/check_files.h"
#include "control/plc/front/reader.h"

namespace indurop::plc {

WatchPlan watch_plan(CompileOptions options, const glb2idl::FileReader& read) {
  WatchPlan plan;
  options.watch = true;
  Diagnostics diagnostics;
  plan.program = check_files(options, module_name(options), read, diagnostics, plan.diagnostics);
  if (!diagnostics.failed() && plan.program != nullptr) {
    plan.ok = true;
    plan.space = plan.program->space;
    for (const TaskPlan& task : plan.program->tasks) {
      plan.modules.push_back(module_of(*plan.program, task, module_name(options)));
      for (const TaskProgram& one : task.programs) {
        plan.instances.push_back(&one);
        plan.layouts.push_back(watch_layout(one));
      }
    }
    Diagnostics quiet;  // the check has reported all of it
    plan.document = read_document(options.files, {.in_editor = options.dialect == Dialect::Codesys}, read, quiet);
  }
  for (base::Diagnostic& one : diagnostics.list()) {
    if (one.severity == base::Diagnostic::Severity::Error) {  // the build has reported the warnings
      plan.diagnostics.push_back(std::move(one));
    }
  }
  return plan;
}

}  // namespace indurop::plc
