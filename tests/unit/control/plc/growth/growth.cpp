// SPDX-License-Identifier: Apache-2.0
// growth --list: the names and first sizes of all texts. growth NAME N: compiles, prints and writes that text as
// `indurop plc` does and says what became of it; growth_test.py counts the instructions of that.

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>

#include "control/plc/front/compiler.h"
#include "control/plc/front/reader.h"
#include "control/plc/plcopen/project_writer.h"
#include "control/plc/print/print.h"
#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"
#include "tests/unit/control/plc/growth/growing_programs.h"

namespace {

using namespace indurop;  // NOLINT(google-build-using-namespace)

int say(bool ok, const std::vector<base::Diagnostic>& diagnostics, std::size_t bytes) {
  std::cout << (ok ? "fine" : "refused") << ", " << bytes << " bytes\n";
  for (std::size_t i = 0; i < diagnostics.size() && i < 3; ++i) {
    std::cout << base::to_string(diagnostics[i]).substr(0, 200) << '\n';
  }
  return 0;
}

int shared(const std::string& text) {
  const auto read = [&](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; };
  const glb2idl::Compilation made = glb2idl::compile({"in.glb"}, read);
  std::size_t bytes = 0;
  if (made.ok) {
    for (const auto& one : glb2idl::emit_all(made.program)) {
      bytes += one.text.size();
    }
    bytes += glb2idl::emit_ros2(made.program).outputs.size();
  }
  return say(made.ok, made.diagnostics, bytes);
}

int program(const std::string& text, const std::string& file) {
  const auto read = [&](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; };
  plc::CompileOptions options;
  options.files = {file};
  options.name = "sut";
  options.show_locals = true;
  options.watch = true;
  options.dialect = plc::Dialect::Codesys;
  const plc::Compiled made = plc::compile(options, read);
  std::size_t bytes = made.glb.size();
  for (const plc::ModuleText& one : made.modules) {
    bytes += one.cpp.size();
  }
  plc::Diagnostics diagnostics;
  plc::plcopen::Document document = plc::read_document({file}, {}, read, diagnostics);
  bytes += plc::print_text(plc::printed_bodies(document, ""), true, diagnostics).size();
  bytes += plc::plcopen::write_project(document, {.name = "sut", .created = "2024-01-01T00:00:00"}, diagnostics).size();
  return say(made.ok && !diagnostics.failed(), made.ok ? diagnostics.list() : made.diagnostics, bytes);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  for (const plc::testing::GrowingText& one : plc::testing::growing_texts()) {
    if (wanted == "--list") {
      std::cout << one.name << ' ' << one.first << '\n';
    } else if (wanted == one.name && argc > 2) {
      const std::string text = one.text(std::strtoul(argv[2], nullptr, 10));
      if (argc > 3) {
        std::ofstream(argv[3]) << text;
      }
      return std::string_view(one.file) == "in.glb" ? shared(text) : program(text, one.file);
    }
  }
  return wanted == "--list" ? 0 : 2;
}
