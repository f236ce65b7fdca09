// SPDX-License-Identifier: Apache-2.0
// The question that the running job asks the operator, from its ASK to its answer. Real-time safe.

#pragma once

#include <indurop/robot/questions.h>

#include <cstdint>
#include <span>

#include "control/robot/job/job.h"
#include "control/robot/job/step_values.h"

namespace indurop::robot {

class OpenQuestion {
 public:
  // The book is borrowed. `first`: null: 1.
  explicit OpenQuestion(const JobBook& book, FirstQuestion first = nullptr) noexcept : book_(book), first_(first) {}

  // What remains of the question while an interrupt is served.
  struct Asked {
    std::uint32_t number = 0;  // 0: nothing is asked
    int question = -1;         // of the book
    double lower = 0;
    double upper = 0;
    double left = 0;  // s until it times out; 0: it never does
    bool is_answered = false;
    double answer = 0;
    char text[160] = "";
  };
  [[nodiscard]] const Asked& asked() const noexcept { return asked_; }
  void set_asked(const Asked& asked) noexcept { asked_ = asked; }
  // Asks nothing any more. Later questions have other numbers.
  void close() noexcept { asked_ = {}; }
  [[nodiscard]] bool is_open() const noexcept { return asked_.number != 0 && !asked_.is_answered; }

  // Asks what the step asks, unless it does so already. `waited`: s for which it has been asked. `answered`: 1 if the
  // answer has come; then the variable has it.
  StepValues::Flaw ask(const Step& step, double waited, StepValues& values, Signals& signals, const MotionPort& port,
                       double& answered) noexcept;
  // Takes the answer of question `number`, if that is open and has this answer. Errors: State, Value; `why` gets the
  // text.
  ErrorCode answer(std::uint32_t number, double value, std::span<char> why) noexcept;
  // Reports the question; it is open.
  void report(QuestionReport& to) const noexcept;

 private:
  StepValues::Flaw open(const Step& step, const StepValues& values, Signals& signals, const MotionPort& port) noexcept;
  [[nodiscard]] const JobQuestion& question() const noexcept {
    return book_.questions[static_cast<std::size_t>(asked_.question)];
  }

  const JobBook& book_;
  Asked asked_;
  FirstQuestion first_;
  std::uint32_t last_ = 0;  // number of the last question; 0: none was asked
};

}  // namespace indurop::robot
