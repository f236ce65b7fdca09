// SPDX-License-Identifier: Apache-2.0
// The meaning of the numbers that a module built with --debug sends to a debugger.

#pragma once

#include <cstdint>
#include <vector>

#include "control/plc/emit/watch_layout.h"

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
  std::uint64_t mark = 0;     // differs from that of other programs
  std::vector<Line> lines;    // statements
  std::vector<Frame> frames;  // bodies
  FrameLayout globals;        // shared variables as the scan sees them, and global instances
};

}  // namespace indurop::plc
