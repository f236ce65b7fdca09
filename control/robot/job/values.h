// SPDX-License-Identifier: Apache-2.0
// Statements about values: shared variables that are set, at rest or during a motion, and variables of the job.

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class ValueReader {
 public:
  explicit ValueReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), expressions_(parts.expressions) {}

  void set();
  void pulse();
  void variable();
  void parameters();
  void assign();

 private:
  void add_setting(Step step);
  void set_on_path(Step wanted);

  JobLine& line_;
  JobDraft& draft_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
