// SPDX-License-Identifier: Apache-2.0
// Answers to questions of the job: takes each one once, and reports what became of the last one.

#pragma once

#include <indurop/robot/questions.h>

#include "control/robot/job/runner.h"

namespace indurop::robot {

class AnswerDesk {
 public:
  // The job is borrowed.
  explicit AnswerDesk(JobRunner& job) noexcept : job_(job) {}

  // Takes an answer if its number is new. Real-time safe, like all functions of this class.
  void serve(const AnswerRequest& request) noexcept;
  void report(QuestionReport& to) const noexcept;

 private:
  ErrorCode answer(const AnswerRequest& request) noexcept;

  JobRunner& job_;
  bool first_ = true;
  std::uint32_t acknowledged_ = 0;
  ErrorCode error_ = ErrorCode::Ok;
  char why_[120] = "";
};

}  // namespace indurop::robot
