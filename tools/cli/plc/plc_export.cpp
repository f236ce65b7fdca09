// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_export.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

#include "control/plc/front/compiler.h"
#include "control/plc/front/reader.h"
#include "control/plc/plcopen/project_writer.h"
#include "core/base/replace_file.h"
#include "tools/cli/plc/plc_file.h"
#include "tools/cli/plc/plc_sources.h"
#include "tools/client/process/interrupt.h"

namespace indurop::tools {
namespace {

struct PlcExportRequest {
  plc::CompileOptions compile;
  std::string output;
};

std::string now() {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(seconds));
}

// Prints the diagnostics of `check`, then what the format does not support.
std::optional<std::string> text_of(Context& context, const PlcExportRequest& request) {
  const auto files = with_project_files(context, request.compile.files);
  if (!files) {
    return std::nullopt;
  }
  const EndsAtOnce ends;
  plc::CompileOptions compile = request.compile;
  compile.library = true;
  compile.files = *files;
  const plc::Compiled compiled = plc::compile(compile);
  if (!compiled.ok) {
    print_diagnostics(context, compiled.diagnostics);
    return std::nullopt;
  }
  plc::Diagnostics diagnostics;
  const plc::ReadOptions reading{.in_editor = compile.dialect == plc::Dialect::Codesys};
  plc::plcopen::Document document = plc::read_document(*files, reading, &glb2idl::read_source_file, diagnostics);
  document.project.dialect = compile.dialect.value_or(document.project.dialect);
  plc::plcopen::WriteOptions options;
  options.name = std::filesystem::path(compile.files.front()).stem().string();
  options.created = now();
  std::string text = diagnostics.failed() ? std::string() : plc::plcopen::write_project(document, options, diagnostics);
  print_diagnostics(context, diagnostics.list());
  return diagnostics.failed() ? std::nullopt : std::optional(std::move(text));
}

int export_plc(Context& context, const PlcExportRequest& request) {
  const std::optional<std::string> text = text_of(context, request);
  if (!text) {
    return kCheckFailed;
  }
  if (request.output.empty()) {
    context.out.write(*text);
    return kOk;
  }
  if (const auto saved = base::replace_file(request.output, *text, base::Durable::No); !saved) {
    context.out.error(base::cannot_write(request.output, saved.error()));
    return kFailed;
  }
  context.out.note("PLCopen XML written to " + request.output);
  return kOk;
}

}  // namespace

void add_plc_export(base::Options& app, const std::shared_ptr<Action>& chosen) {
  auto request = std::make_shared<PlcExportRequest>();
  base::Options& made =
      app.command("export", "Write a program as PLCopen XML, which Beremiz, the OpenPLC editor and CODESYS import",
                  [request, chosen] { *chosen = [request](Context& c) { return export_plc(c, *request); }; });
  add_plc_sources(made, request->compile);
  made.add("-o,--output", "FILE.xml", request->output, "Where to write it (default: to the terminal)");
}

}  // namespace indurop::tools
