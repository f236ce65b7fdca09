// SPDX-License-Identifier: Apache-2.0
// Emits the .glb file of a PLC program: its globals, located variables and shared locals, with the types they need.

#pragma once

#include <string>
#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

struct GlbFile {
  std::string text;
  std::vector<Place> places;  // of each line, from line 1; unknown for generated lines
};

// `watch`: include the variables that modules report to a running view.
[[nodiscard]] GlbFile emit_glb(const Program& program, const std::string& sources, bool show_locals,
                               bool watch = false);

}  // namespace indurop::plc
