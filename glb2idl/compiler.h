// SPDX-License-Identifier: Apache-2.0
// Compiles .glb files to a checked program. Used by the program glb2idl, by tests and by the PLC compiler.

#pragma once

#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "glb2idl/program.h"
#include "glb2idl/source.h"

namespace indurop::glb2idl {

struct Compilation {
  bool ok = false;
  std::vector<base::Diagnostic> diagnostics;  // all errors, sorted by file and place
  std::vector<base::Diagnostic> notes;        // if ok: known errors of third-party compilers with this IDL
  std::vector<std::string> files;             // every file that was read, including includes
  Program program;                            // complete if ok
};

// Compiles `inputs` and everything they include. Never throws on bad input.
[[nodiscard]] Compilation compile(const std::vector<std::string>& inputs, const FileReader& read = read_source_file);

}  // namespace indurop::glb2idl
