// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_print.h"

#include <fmt/format.h>

#include <optional>

#include "control/plc/front/reader.h"
#include "control/plc/print/print.h"
#include "core/base/replace_file.h"
#include "tools/cli/plc/plc_file.h"
#include "tools/cli/plc/plc_sources.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

struct PlcPrintRequest {
  std::vector<std::string> files;
  std::string svg;
  std::string pou;
  std::optional<plc::Dialect> dialect;
};

std::string names_of(const plc::plcopen::Document& document) {
  std::string names;
  for (const plc::plcopen::PouDocument& each : document.pous) {
    names += (names.empty() ? "" : ", ") + each.pou.name;
  }
  return names;
}

int print(Context& context, const PlcPrintRequest& request) {
  std::optional<EndsAtOnce> ends(std::in_place);
  plc::Diagnostics diagnostics;
  const plc::ReadOptions reading{.in_editor = request.dialect == plc::Dialect::Codesys};
  const auto files = with_project_files(context, request.files);
  if (!files) {
    return kCheckFailed;
  }
  plc::plcopen::Document document = plc::read_document(*files, reading, &glb2idl::read_source_file, diagnostics);
  const auto bodies = plc::printed_bodies(document, request.pou);
  const bool only_svg = !request.svg.empty();
  const std::string out = diagnostics.failed() ? std::string()
                          : only_svg           ? plc::print_svg(bodies, diagnostics)
                                               : plc::print_text(bodies, context.out.unicode(), diagnostics);
  ends.reset();
  if (diagnostics.failed()) {
    print_diagnostics(context, diagnostics.list());
    return kCheckFailed;
  }
  if (bodies.empty()) {
    const std::string names = names_of(document);
    const std::string shown = request.files.size() == 1 ? request.files.front() : "the program";
    context.out.error(names.empty() ? fmt::format("{} has no program to print, only types or variables", shown)
                                    : fmt::format("{} has no POU '{}'; it has {}", shown, request.pou, names));
    return kFailed;
  }
  if (!only_svg) {
    context.out.write(out);
    return kOk;
  }
  if (const auto saved = base::replace_file(request.svg, out, base::Durable::No); !saved) {
    context.out.error(base::cannot_write(request.svg, saved.error()));
    return kFailed;
  }
  context.out.note(fmt::format("picture written to {}", request.svg));
  return kOk;
}

}  // namespace

void add_plc_print(base::Options& app, const std::shared_ptr<Action>& chosen) {
  auto request = std::make_shared<PlcPrintRequest>();
  base::Options& made =
      app.command("print", "Print a program, with its networks as text or as a picture",
                  [request, chosen] { *chosen = [request](Context& c) { return print(c, *request); }; });
  made.add("files", "FILE", request->files,
           "The program: .st, PLCopen .xml, OpenPLC's project.json, TwinCAT .plcproj or .TcPOU files")
      .required();
  made.add("--svg", "FILE", request->svg, "Draw the networks into this SVG file instead");
  made.add("--pou", "NAME", request->pou, "This program, function or function block only");
  add_plc_dialect(made, request->dialect);
}

}  // namespace indurop::tools
