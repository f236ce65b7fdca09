// SPDX-License-Identifier: Apache-2.0
// Statements whose expressions are evaluated in each period from there on: corrections of the path, outputs that
// follow the motion, and frames that move.

#pragma once

#include <vector>

#include "control/robot/job/statement.h"

namespace indurop::robot {

class EachPeriodReader {
 public:
  explicit EachPeriodReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions) {}

  void correct();
  void follow();
  void track();

 private:
  bool amount(double& to, const char* word, const char* unit, const char* wrong);
  void age(JobCorrection& correction);
  std::vector<Formula> checked(std::vector<Formula> formulas, const JobToken& at);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
