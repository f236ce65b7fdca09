// SPDX-License-Identifier: Apache-2.0
// Jogs a robot from a terminal, as long as the command runs.

#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

// A request that ROBOT_JOG holds while a command runs.
struct HeldJog {
  std::string verb;                // for messages: "robot jog"
  std::string fields;              // of ROBOT_JOG in addition to bEnable and nBeat: "eFrame: 1, dSpeed: [...]"
  std::string note;                // shown once it is requested
  std::int64_t for_ns = 0;         // 0: until Ctrl-C
  std::function<int()> each = {};  // called every 20 ms; an exit code other than kOk ends it
};
// Requests it until its time is over or Ctrl-C, then releases the switch. Returns the exit code, after a message.
int hold_jog(Context& context, vars::Store& store, const RobotChoice& choice, const HeldJog& held);

struct Hand {
  std::string direction;    // "J1+", "x-", "rz+"
  std::string frame;        // frame of x to rz: "base", "tool" or a work frame
  double percent = 10;      // share of the maximum jog speed
  std::int64_t for_ns = 0;  // 0: until Ctrl-C
};
// The robot stops when this ends for whatever reason: the command is repeated ten times a second, and the robot stops
// 0.3 s after the last one. Returns the exit code, after a message.
int jog(Context& context, const RobotChoice& choice, const Hand& hand);

}  // namespace indurop::tools
