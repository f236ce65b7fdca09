// SPDX-License-Identifier: Apache-2.0
// From files of a PLC program to the texts of its modules: .glb, C++, and the lines for module.xml.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "glb2idl/source.h"
#include "plc/emit/debug_table.h"
#include "plc/model/dialect.h"

namespace indurop::plc {

struct CompileOptions {
  std::vector<std::string> files;
  std::vector<std::string> libraries;  // .plclib files, "motors.plclib@1.2"
  std::vector<std::string> glb_files;  // whose shared variables the program may use
  std::string name;                    // of the module; empty: the first file's name
  std::string space;                   // namespace of its shared variables; empty: the module's name, "plc" for main
  std::optional<Dialect> dialect;      // none: of the editor that wrote the files, as far as they say
  bool show_locals = false;
  bool library = false;            // there may be no PROGRAM, then there are no modules
  bool infinite_division = false;  // a REAL divided by zero is infinite or NaN, else a fault
  bool watch = false;              // modules tell `indurop plc watch` about their variables
  bool debug = false;              // modules can be stopped by `indurop plc debug`
  bool coverage = false;           // modules count how often their statements run
};

struct ModuleText {
  std::string name;  // "main"; with several tasks "main_fast"
  std::string cpp;
  std::int64_t period_ns = 0;  // 0: it is sporadic
  std::int32_t priority = 1;
  DebugTable debug;
};

struct Compiled {
  bool ok = false;
  Dialect dialect = Dialect::Iec;             // that counted
  std::vector<base::Diagnostic> diagnostics;  // in the order of the files; errors in .glb files come first
  std::string name;
  std::string glb;  // text of <name>.glb, with includes of the other files
  std::vector<ModuleText> modules;
  std::shared_ptr<const Program> program;  // with CompileOptions::debug: what `debug` of the modules refers to
};

[[nodiscard]] Compiled compile(const CompileOptions& options,
                               const glb2idl::FileReader& read = glb2idl::read_source_file);

// <module>...</module> for each of them, as module.xml has it.
[[nodiscard]] std::string module_xml(const std::vector<ModuleText>& modules);

}  // namespace indurop::plc
