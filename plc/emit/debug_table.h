// SPDX-License-Identifier: Apache-2.0
// What the numbers mean that a module built with --debug tells a debugger.

#pragma once

#include <cstdint>
#include <vector>

#include "plc/emit/watch_layout.h"

namespace indurop::plc {

struct DebugTable {
  struct Line {
    Place at;
    const Pou* pou = nullptr;
  };
  struct Frame {
    const Pou* pou = nullptr;
    FrameLayout layout;
  };
  std::uint64_t mark = 0;     // of another program it is another number
  std::vector<Line> lines;    // statements
  std::vector<Frame> frames;  // bodies
  FrameLayout globals;        // what a scan sees of shared variables, and instances that are global
};

}  // namespace indurop::plc
