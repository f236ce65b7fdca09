// SPDX-License-Identifier: Apache-2.0
// Statements about tools and loads: their declaration, their masses, and what is held from here on.

#pragma once

#include <set>
#include <string>

#include "control/robot/job/statement.h"

namespace indurop::robot {

class ToolReader {
 public:
  explicit ToolReader(const StatementParts& parts) : line_(parts.line), draft_(parts.draft), names_(parts.names) {
    for (const Tool& tool : draft_.book().tools) {
      tools_.insert(tool.name);
    }
  }

  void tool();
  void load();

 private:
  void taught_tool(Tool& tool);
  void mass(Body& body);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  std::set<std::string> tools_;  // names
};

}  // namespace indurop::robot
