// SPDX-License-Identifier: Apache-2.0
// Questions that robots ask their operators: shows them, and answers one.

#pragma once

#include <cstdint>
#include <string>

#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

struct RobotAnswer {
  std::string text;            // one of the choices, its number, or the number that was asked for
  std::uint64_t question = 0;  // 0: the one that is open
};
// Both return the exit code, after messages. show_question() waits for a question for `wait_ns`.
int show_question(Context& context, const RobotChoice& choice, std::int64_t wait_ns);
int answer_question(Context& context, const RobotChoice& choice, const RobotAnswer& answer);

}  // namespace indurop::tools
