// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/open_question.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace indurop::robot {

StepValues::Flaw OpenQuestion::ask(const Step& step, double waited, StepValues& values, Signals& signals,
                                   const MotionPort& port, double& answered) noexcept {
  if (asked_.number == 0) {
    if (const auto flaw = open(step, values, signals, port); !flaw.ok()) {
      close();
      return flaw;
    }
  }
  asked_.left = std::max(0.0, step.timeout - waited);
  answered = asked_.is_answered ? 1 : 0;
  if (asked_.is_answered) {
    values.store(question().variable, asked_.answer);
    close();
  }
  return {};
}

StepValues::Flaw OpenQuestion::open(const Step& step, const StepValues& values, Signals& signals,
                                    const MotionPort& port) noexcept {
  asked_.question = step.slot;
  const JobQuestion& question = this->question();
  if (const auto flaw = values.text(question.text, signals, port, asked_.text); !flaw.ok()) {
    return flaw;
  }
  double range[2] = {1, static_cast<double>(question.choices.size())};
  if (question.lower >= 0) {
    if (const auto flaw = values.numbers(question.lower, 2, signals, port, range); !flaw.ok()) {
      return flaw;
    }
    if (range[0] > range[1]) {
      return {"no number is in the range of this question; check its ends before, with IF",
              book_.formulas[static_cast<std::size_t>(question.lower)].column()};
    }
  }
  asked_.lower = range[0];
  asked_.upper = range[1];
  last_ = last_ == 0 && first_ != nullptr ? first_() : last_ + 1;
  last_ = last_ == 0 ? 1 : last_;  // 0 is none
  asked_.number = last_;
  return {};
}

ErrorCode OpenQuestion::answer(std::uint32_t number, double value, std::span<char> why) noexcept {
  if (number != asked_.number) {
    std::snprintf(why.data(), why.size(), "question %u is not open, question %u is", number, asked_.number);
    return ErrorCode::State;
  }
  constexpr double kRounding = 1e-9;
  const double step = question().step;
  const double nearest = asked_.lower + step * std::round((value - asked_.lower) / step);
  const bool is_in_range = value >= asked_.lower && value <= asked_.upper;  // not if it is no number
  if (!is_in_range || !(std::abs(value - nearest) <= kRounding * std::max(1.0, std::abs(value)))) {
    std::snprintf(why.data(), why.size(), "question %u takes %g to %g in steps of %g, not %.10g", number, asked_.lower,
                  asked_.upper, step, value);
    return ErrorCode::Value;
  }
  asked_.is_answered = true;
  asked_.answer = std::min(nearest, asked_.upper);
  return ErrorCode::Ok;
}

void OpenQuestion::report(QuestionReport& to) const noexcept {
  const JobQuestion& question = this->question();
  to.number = asked_.number;
  to.text = asked_.text;
  to.count = question.choices.size();
  std::transform(question.choices.begin(), question.choices.end(), to.choices.begin(),
                 [](const std::string& choice) { return choice.c_str(); });
  to.lower = asked_.lower;
  to.upper = asked_.upper;
  to.step = question.step;
  to.left = asked_.left;
}

}  // namespace indurop::robot
