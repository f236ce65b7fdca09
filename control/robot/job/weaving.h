// SPDX-License-Identifier: Apache-2.0
// The statement that lets the tool weave across its path from there on.

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class WeaveReader {
 public:
  explicit WeaveReader(const StatementParts& parts) : line_(parts.line), draft_(parts.draft) {}

  void weave();

 private:
  bool shape(Wave& wave);
  bool size(double& to, const char* word, double most);
  void turn(Wave& wave);

  JobLine& line_;
  JobDraft& draft_;
};

}  // namespace indurop::robot
