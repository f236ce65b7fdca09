// SPDX-License-Identifier: Apache-2.0
// Compiles the files of a PLC program to the texts of its modules: .glb, C++, and the lines for module.xml.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/plc/emit/debug_table.h"
#include "control/plc/model/dialect.h"
#include "core/base/diagnostic.h"
#include "glb2idl/source.h"

namespace indurop::plc {

struct CompileOptions {
  std::vector<std::string> files;
  std::vector<std::string> libraries;  // .plclib files, "motors.plclib@1.2"
  std::vector<std::string> glb_files;  // shared variables that the program may use
  std::string name;                    // of the module; empty: that of the first file
  std::string space;                   // of its shared variables; empty: the module's name, "plc" for main
  std::optional<Dialect> dialect;      // none: that of the editor that wrote the files, if they identify it
  bool show_locals = false;
  bool library = false;            // a PROGRAM is not required; without one there are no modules
  bool infinite_division = false;  // a REAL divided by zero is infinite or NaN; otherwise it is a fault
  bool watch = false;              // modules report their variables to `indurop plc watch`
  bool debug = false;              // modules can be stopped by `indurop plc debug`
  bool coverage = false;           // modules count how often their statements run
};

struct ModuleText {
  std::string name;  // "main"; with several tasks "main_fast"
  std::string cpp;
  std::int64_t period_ns = 0;  // 0: sporadic
  std::int32_t priority = 1;
  DebugTable debug;
};

struct Compiled {
  bool ok = false;
  Dialect dialect = Dialect::Iec;             // the dialect that was used
  std::vector<base::Diagnostic> diagnostics;  // in file order; errors in .glb files come first
  std::string name;
  std::string glb;  // text of <name>.glb, with includes of the other files
  std::vector<ModuleText> modules;
  std::shared_ptr<const Program> program;  // with CompileOptions::debug: target of `debug` of the modules
};

[[nodiscard]] Compiled compile(const CompileOptions& options,
                               const glb2idl::FileReader& read = glb2idl::read_source_file);

// Returns <module>...</module> for each module, in the format of module.xml. `folder`: where the modules are, as seen
// from the folder of module.xml.
[[nodiscard]] std::string module_xml(const std::vector<ModuleText>& modules, const std::string& folder = ".");

}  // namespace indurop::plc
