// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_sources.h"

namespace indurop::tools {

void add_plc_dialect(base::Options& app, std::optional<plc::Dialect>& dialect) {
  const base::Take take = [&dialect](const std::string& text) {
    dialect = text == "codesys" ? plc::Dialect::Codesys : plc::Dialect::Iec;
    return std::string();
  };
  app.add("--dialect", "DIALECT", take,
          "Rules of implicit conversions: iec or codesys (default: those of the editor that wrote the files)")
      .choices({"iec", "codesys"});
}

void add_plc_sources(base::Options& app, plc::CompileOptions& request) {
  app.add("files", "FILE", request.files,
          "The program: .st, PLCopen .xml, OpenPLC's project.json, TwinCAT .plcproj or .TcPOU files")
      .required();
  app.add("--lib", "FILE", request.libraries,
          "A library that the program uses, e.g. motors-1.2.0.plclib; FILE@1.2 requires at least this version "
          "(repeatable)")
      .one_at_a_time();
  app.add("--glb", "FILE", request.glb_files, "A .glb file whose shared variables the program uses (repeatable)")
      .one_at_a_time();
  app.add("--name", "NAME", request.name, "Name of the module (default: the first file's)");
  app.add("--namespace", "NAME", request.space, "Namespace of its shared variables (default: the module's name)");
  add_plc_dialect(app, request.dialect);
  const base::Take divide = [&request](const std::string& text) {
    request.infinite_division = text == "infinity";
    return std::string();
  };
  app.add("--real-division", "RESULT", divide, "Result of dividing a REAL by zero: fault or infinity (default: fault)")
      .choices({"fault", "infinity"});
  app.flag("--show-locals", request.show_locals, "Also make the variables of programs shared variables");
}

}  // namespace indurop::tools
