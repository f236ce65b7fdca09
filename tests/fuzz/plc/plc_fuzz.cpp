// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a PLC program holds: the compiler ends with modules or with messages, never with a crash. Inputs that
// begin with '<' are PLCopen XML, which is printed too, all others Structured Text.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "control/plc/front/compiler.h"
#include "control/plc/print/print.h"

namespace {

using namespace indurop;  // NOLINT(google-build-using-namespace)

void require(bool condition) {
  if (!condition) {
    std::abort();
  }
}

void compile(const std::string& text, bool drawn) {
  plc::CompileOptions options;
  options.files = {drawn ? "in.xml" : "in.st"};
  options.name = "fuzzed";
  options.watch = drawn;
  const auto compiled = plc::compile(options, [&](const std::string& name) {
    return glb2idl::ReadResult{text, name, ""};
  });
  require(compiled.ok ? !compiled.modules.empty() : !compiled.diagnostics.empty());
}

void print(const std::string& text) {
  plc::Diagnostics diagnostics;
  plc::plcopen::Document document = plc::plcopen::read_document(text, "in.xml", diagnostics);
  const auto bodies = plc::printed_bodies(document, "");
  (void)plc::print_text(bodies, true, diagnostics);
  require(plc::print_svg(bodies, diagnostics).starts_with("<svg"));
  require(!diagnostics.failed() || !diagnostics.list().empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const bool drawn = text.starts_with('<');
  compile(text, drawn);
  if (drawn) {
    print(text);
  }
  return 0;
}
