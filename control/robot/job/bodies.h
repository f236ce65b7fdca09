// SPDX-License-Identifier: Apache-2.0
// Statements about bodies: zones that the arm must not enter, and parts of its tools.

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class BodyReader {
 public:
  explicit BodyReader(const StatementParts& parts) : line_(parts.line), draft_(parts.draft), names_(parts.names) {}

  void keepout();
  void body();

 private:
  bool begin_body(BodyLine& line, const char* example);
  bool solid(Solid& solid);
  double radius();

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
};

}  // namespace indurop::robot
