// SPDX-License-Identifier: Apache-2.0
// The data that a view of a running program needs: its code, and the positions of its values.

#pragma once

#include <memory>
#include <vector>

#include "control/plc/emit/watch_layout.h"
#include "control/plc/front/compiler.h"
#include "control/plc/plcopen/document.h"

namespace indurop::plc {

struct WatchPlan {
  bool ok = false;
  std::vector<base::Diagnostic> diagnostics;
  std::string space;                 // namespace of the shared variables
  std::unique_ptr<Program> program;  // the program that `layouts` refer to
  std::vector<std::string> modules;  // of each of its tasks
  std::vector<const TaskProgram*> instances;
  std::vector<WatchLayout> layouts;  // one for each of them
  plcopen::Document document;
};

// Makes the plan for the options with which a module was built.
[[nodiscard]] WatchPlan watch_plan(CompileOptions options, const glb2idl::FileReader& read = glb2idl::read_source_file);

}  // namespace indurop::plc
