// SPDX-License-Identifier: Apache-2.0
// A robot moved by hand from a terminal, as long as the command runs.

#pragma once

#include <cstdint>
#include <string>

#include "tools/robot/robot_desk.h"

namespace indurop::tools {

struct Hand {
  std::string direction;    // "J1+", "x-", "rz+"
  std::string frame;        // of x to rz: "base", "tool" or a work frame
  double percent = 10;      // of the fastest by hand
  std::int64_t for_ns = 0;  // 0: until Ctrl-C
};
// The robot rests when this ends, however: it is told ten times a second that the hand is there, and rests 0.3 s after
// the last time. Returns the exit code, after a message.
int jog(Context& context, const RobotChoice& choice, const Hand& hand);

}  // namespace indurop::tools
