// SPDX-License-Identifier: Apache-2.0
#include "tools/plc/plc_export.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "base/replace_file.h"
#include "plc/front/reader.h"
#include "plc/plcopen/project_writer.h"
#include "tools/plc/plc_file.h"
#include "tools/plc/plc_sources.h"

namespace indurop::tools {
namespace {

struct Request {
  std::vector<std::string> files;
  std::string output;
  std::optional<plc::Dialect> dialect;
};

std::string now() {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(seconds));
}

int export_plc(Context& context, const Request& request) {
  plc::Diagnostics diagnostics;
  const plc::ReadOptions reading{.in_editor = request.dialect == plc::Dialect::Codesys};
  plc::plcopen::Document document =
      plc::read_document(with_project_files(request.files), reading, &glb2idl::read_source_file, diagnostics);
  document.project.dialect = request.dialect.value_or(document.project.dialect);
  plc::plcopen::WriteOptions options;
  options.name = std::filesystem::path(request.files.front()).stem().string();
  options.created = now();
  const std::string text =
      diagnostics.failed() ? std::string() : plc::plcopen::write_project(document, options, diagnostics);
  print_diagnostics(context, diagnostics.list());
  if (diagnostics.failed()) {
    return kCheckFailed;
  }
  if (request.output.empty()) {
    context.out.write(text);
    return kOk;
  }
  if (const auto saved = base::replace_file(request.output, text, base::Durable::No); !saved) {
    context.out.error(base::cannot_write(request.output, saved.error()));
    return kFailed;
  }
  context.out.note("PLCopen XML written to " + request.output);
  return kOk;
}

}  // namespace

void add_plc_export(base::Options& app, const std::shared_ptr<Action>& chosen) {
  auto request = std::make_shared<Request>();
  base::Options& made =
      app.command("export", "Write a program as PLCopen XML, which Beremiz, the OpenPLC editor and CODESYS import",
                  [request, chosen] { *chosen = [request](Context& c) { return export_plc(c, *request); }; });
  made.add("files", "FILE", request->files,
           "The program: .st, PLCopen .xml, OpenPLC's project.json, TwinCAT .plcproj or .TcPOU files")
      .required();
  made.add("-o,--output", "FILE.xml", request->output, "Where to write it (default: to the terminal)");
  add_plc_dialect(made, request->dialect);
}

}  // namespace indurop::tools
