// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/answer_desk.h"

#include <cstdio>

namespace indurop::robot {

void AnswerDesk::serve(const AnswerRequest& request) noexcept {
  if (!request.known || (!first_ && request.number == acknowledged_)) {
    return;
  }
  acknowledged_ = request.number;
  why_[0] = '\0';
  if (first_) {
    // Answers from before this program started belong to other questions.
    first_ = false;
    error_ = request.number != 0 ? ErrorCode::Aborted : ErrorCode::Ok;
    return;
  }
  error_ = answer(request);
}

ErrorCode AnswerDesk::answer(const AnswerRequest& request) noexcept {
  if (OpenQuestion* const question = job_.open_question()) {
    return question->answer(request.question, request.value, why_);
  }
  std::snprintf(why_, sizeof why_, "no question is open");
  return ErrorCode::State;
}

void AnswerDesk::report(QuestionReport& to) const noexcept {
  if (const OpenQuestion* const question = job_.open_question()) {
    question->report(to);
  }
  to.acknowledged = acknowledged_;
  to.error = error_;
  to.reason = why_;
}

}  // namespace indurop::robot
