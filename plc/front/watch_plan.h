// SPDX-License-Identifier: Apache-2.0
// What a view of a running program needs to know: its code, and where its values are.

#pragma once

#include <memory>
#include <vector>

#include "plc/emit/watch_layout.h"
#include "plc/front/compiler.h"
#include "plc/plcopen/document.h"

namespace indurop::plc {

struct WatchPlan {
  bool ok = false;
  std::vector<base::Diagnostic> diagnostics;
  std::string space;                 // of the shared variables
  std::unique_ptr<Program> program;  // what `layouts` refer to
  std::vector<const TaskProgram*> instances;
  std::vector<WatchLayout> layouts;  // of each of them
  plcopen::Document document;
};

// For the options a module was built with.
[[nodiscard]] WatchPlan watch_plan(CompileOptions options, const glb2idl::FileReader& read = glb2idl::read_source_file);

}  // namespace indurop::plc
