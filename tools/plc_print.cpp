// SPDX-License-Identifier: Apache-2.0
#include "tools/plc_print.h"

#include <fmt/format.h>

#include "plc/print/print.h"
#include "tools/plc_file.h"
#include "tools/save_file.h"

namespace indurop::tools {
namespace {

struct Request {
  std::string file;
  std::string svg;
  std::string pou;
};

std::string names_of(const plc::plcopen::Document& document) {
  std::string names;
  for (const plc::plcopen::PouDocument& each : document.pous) {
    names += (names.empty() ? "" : ", ") + each.pou.name;
  }
  return names;
}

int print(Context& context, const Request& request) {
  std::string bytes;
  if (!read_plc_file(context, request.file, bytes)) {
    return kFailed;
  }
  plc::Diagnostics diagnostics;
  plc::plcopen::Document document = plc::plcopen::read_document(bytes, request.file, diagnostics);
  const auto bodies = plc::printed_bodies(document, request.pou);
  const bool only_svg = !request.svg.empty();
  const std::string out = diagnostics.failed() ? std::string()
                          : only_svg           ? plc::print_svg(bodies, diagnostics)
                                               : plc::print_text(bodies, context.out.unicode(), diagnostics);
  if (diagnostics.failed()) {
    context.out.message_line(diagnostics.render());
    return kCheckFailed;
  }
  if (bodies.empty()) {
    const std::string names = names_of(document);
    context.out.error(names.empty() ? fmt::format("{} has no program to print, only types or variables", request.file)
                                    : fmt::format("{} has no POU '{}'; it has {}", request.file, request.pou, names));
    return kFailed;
  }
  if (!only_svg) {
    context.out.write(out);
    return kOk;
  }
  if (const std::string problem = save_file(request.svg, out); !problem.empty()) {
    context.out.error(problem);
    return kFailed;
  }
  context.out.note(fmt::format("picture written to {}", request.svg));
  return kOk;
}

}  // namespace

void add_plc_print(CLI::App& app, const std::shared_ptr<Action>& chosen) {
  auto request = std::make_shared<Request>();
  CLI::App* made = app.add_subcommand("print", "Print the networks of a PLCopen XML file as text or as a picture");
  made->add_option("file", request->file, "PLCopen XML file")->required()->type_name("FILE.xml");
  made->add_option("--svg", request->svg, "Draw the networks into this SVG file instead")->type_name("FILE");
  made->add_option("--pou", request->pou, "This program, function or function block only")->type_name("NAME");
  made->fallthrough();
  made->callback([request, chosen] { *chosen = [request](Context& c) { return print(c, *request); }; });
}

}  // namespace indurop::tools
