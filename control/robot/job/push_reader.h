// SPDX-License-Identifier: Apache-2.0
// The statement that lets an axis push with a torque or a force.

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class PushReader {
 public:
  PushReader(const StatementParts& parts, const ArmShape& shape)
      : line_(parts.line), draft_(parts.draft), expressions_(parts.expressions), shape_(shape) {}

  void push();

 private:
  void axis(JobPush& push);
  void torque(JobPush& push);
  void speed(JobPush& push);
  void ramp(JobPush& push);
  void ends(JobPush& push);
  void in_time(const JobPush& push, const JobToken& end);
  [[nodiscard]] bool slides(const JobPush& push) const noexcept {
    return shape_.slides[static_cast<std::size_t>(push.way.axis)];
  }

  JobLine& line_;
  JobDraft& draft_;
  ExpressionReader& expressions_;
  const ArmShape shape_;
};

}  // namespace indurop::robot
