// SPDX-License-Identifier: Apache-2.0
// Questions that jobs ask the operator (ASK), and answers to them.

#pragma once

#include <indurop/robot/words.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace indurop::robot {

inline constexpr std::size_t kMaxChoices = 7;      // of one question
inline constexpr std::size_t kMaxChoiceText = 31;  // bytes

// Returns the number of the first question of a robot task, so that an answer which is late cannot meet a question of a
// later start. A replay takes it from the recording (irp::learned()). Real-time safe. Null: 1.
using FirstQuestion = std::uint32_t (*)() noexcept;

// An answer, as ROBOT_ANSWER. It is rejected unless its question is open and has this answer.
struct AnswerRequest {
  std::uint32_t number = 0;    // differs from last time: a new answer
  std::uint32_t question = 0;  // QuestionReport::number
  double value = 0;            // number of the choice, from 1; or the number that was asked for
  // False until the answering board was received: an old answer is then not mistaken for a new one.
  bool known = true;
};

// The question that is open, as ROBOT_QUESTION. Texts are valid until the next step.
struct QuestionReport {
  std::uint32_t number = 0;  // counts on from Settings::first_question; 0: no question is open
  const char* text = "";
  std::size_t count = 0;  // of choices; 0: the question asks for a number
  std::array<const char*, kMaxChoices> choices{"", "", "", "", "", "", ""};
  double lower = 0, upper = 0;  // range of the answer
  double step = 0;              // answers are whole multiples of it above `lower`
  double left = 0;              // s until it times out; 0: it never does
  std::uint32_t acknowledged = 0;
  ErrorCode error = ErrorCode::Ok;  // of that answer: State: its question is not open; Value: it is none of the answers
  const char* reason = "";          // why it was rejected
};

}  // namespace indurop::robot
