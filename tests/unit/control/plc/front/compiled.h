// SPDX-License-Identifier: Apache-2.0
// Compiles the text of one program, without files.

#pragma once

#include <string>

#include "control/plc/front/compiler.h"

namespace indurop::plc::testing {

// `file`: in.st or in.xml, or whatever the messages should call it.
inline Compiled compiled(const std::string& text, const std::string& file = "in.st") {
  CompileOptions options;
  options.files = {file};
  options.name = "sut";
  return compile(options, [&](const std::string& name) { return glb2idl::ReadResult{text, name, ""}; });
}

inline std::string messages(const Compiled& program) {
  return base::to_text(program.diagnostics);
}

// The messages about the text, none if it compiles.
inline std::string wrong(const std::string& text, const std::string& file = "in.st") {
  const Compiled program = compiled(text, file);
  return program.ok ? std::string() : messages(program);
}

// Everything that is written for the program.
inline std::string written(const Compiled& program) {
  std::string out = program.glb + module_xml(program.modules);
  for (const ModuleText& one : program.modules) {
    out += one.name + one.cpp;
  }
  return out;
}

}  // namespace indurop::plc::testing
