// SPDX-License-Identifier: Apache-2.0
// The questions that robots ask their operators, from their shared variables ROBOT_QUESTION.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/operate/item.h"
#include "store/vars/store.h"

namespace indurop::tools {

struct RobotQuestion {
  std::string space;         // the namespace of the robot's variables
  std::uint64_t number = 0;  // 0: no question is open
  std::string text;
  std::vector<std::string> choices;  // empty: it asks for a number
  double lower = 0, upper = 0, step = 0;
  double left = 0;                 // s until it times out; 0: it never does
  std::uint64_t acknowledged = 0;  // number of the last answer
  std::string reason;              // why that was rejected; empty: it was not
};

// Reads the question of one robot, an item that is its whole ROBOT_QUESTION. Errors: as operate::read().
Result<RobotQuestion, base::Problem> read_question(const vars::Store& store, const operate::Item& item);
// Returns the open questions of all robots of a node.
std::vector<RobotQuestion> open_questions(const vars::Store& store);

// Returns "1 left, 2 right", "1 to 40", "0 to 12 in steps of 0.5".
std::string answers_text(const RobotQuestion& question);

}  // namespace indurop::tools
