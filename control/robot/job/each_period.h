// SPDX-License-Identifier: Apache-2.0
// Statements whose expressions are evaluated in each period from there on: corrections of the path, a tool that
// presses, outputs that follow the motion, and frames that move.

#pragma once

#include <vector>

#include "control/robot/job/statement.h"

namespace indurop::robot {

class EachPeriodReader {
 public:
  explicit EachPeriodReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions) {}

  void correct();
  void press();
  void follow();
  void track();

 private:
  // A word and a number above 0 with its unit, which is converted to m, N and s.
  struct Amount {
    const char* word = nullptr;
    const char* unit = nullptr;
    double most = 0;
    double to_si = 1;
    const char* example = nullptr;
  };
  bool amount(double& to, const Amount& wanted);
  bool word(const Amount& wanted);
  bool number(double& to, const Amount& wanted);
  bool unit(const Amount& wanted);
  bool limits(JobCorrection& correction, const char* example);
  bool direction(JobCorrection& press, std::vector<Formula>& forces);
  bool axis(JobCorrection& press);
  bool permitted(const JobCorrection& press);
  bool stiffness(JobCorrection& press, const char* example);
  void axes(JobCorrection& correction);
  void keep(const JobCorrection& correction);
  void age(JobCorrection& correction);
  std::vector<Formula> checked(std::vector<Formula> formulas, const JobToken& at);

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
