// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/flow_statements.h"

#include <indurop/robot/questions.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/robot/job/constants.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kMaxParts = 16;  // parts of a condition, which is evaluated in each period

}  // namespace

void FlowReader::wait() {
  if (line_.peek().kind == JobToken::Kind::Number) {
    double seconds = 0;
    if (line_.duration(seconds)) {
      draft_.add(Op::WaitTime).value = seconds;
    }
    return;
  }
  const int formula = expressions_.read("a condition");
  Step& step = draft_.add(Op::WaitUntil);
  step.formula = formula;
  timeout(step);
}

void FlowReader::timeout(Step& step) {
  if (!line_.failed() && line_.accept("TIMEOUT")) {
    line_.duration(step.timeout);
  }
}

// Parses "ASK n = "Which tray?" CHOICE "left", "right"", "ASK n = "How many parts?" 1 TO 40 TIMEOUT 30s"
void FlowReader::ask() {
  JobQuestion question;
  const JobToken name = line_.peek();
  const bool keeps_answer = name.kind != JobToken::Kind::Text;
  if (keeps_answer) {
    line_.take();
    if (!line_.accept("=")) {
      line_.error(line_.peek(), "expected '=', found " + JobLine::shown(line_.peek()) +
                                    "; ASK n = \"How many parts?\" 1 TO 40, ASK n = \"Which tray?\" CHOICE \"left\", "
                                    "\"right\"");
    }
  }
  question.text = line_.failed() ? -1 : text();
  if (!line_.failed() && line_.accept("CHOICE")) {
    choices(question);
  } else if (!line_.failed()) {
    range(question);
  }
  if (!line_.failed() && keeps_answer) {
    question.variable = draft_.variable_called(name.text);
    if (draft_.array_at(question.variable) > 0) {
      line_.error(name, in_quotes(name.text) + " is an array; ask for a variable, and assign it to an element then");
    }
    question.variable = question.variable >= 0 ? question.variable : expressions_.declare(name);
  }
  Step& step = draft_.add(Op::Ask);
  step.slot = static_cast<int>(draft_.book().questions.size());
  timeout(step);
  draft_.book().questions.push_back(std::move(question));
}

void FlowReader::choices(JobQuestion& question) {
  do {
    const JobToken choice = line_.take();
    if (choice.kind != JobToken::Kind::Text) {
      line_.error(choice, "expected an answer in quotes, found " + JobLine::shown(choice));
      return;
    }
    const std::string text(choice.text.substr(1, choice.text.size() - 2));
    if (text.empty() || text.size() > kMaxChoiceText) {
      line_.error(choice,
                  "an answer has 1 to " + std::to_string(kMaxChoiceText) + " bytes; explain it in the question");
    } else if (std::find(question.choices.begin(), question.choices.end(), text) != question.choices.end()) {
      line_.error(choice, "there is already an answer " + in_quotes(text));
    } else if (question.choices.size() == kMaxChoices) {
      line_.error(choice, "more than " + std::to_string(kMaxChoices) + " answers; ask for a number, 1 TO 20");
    }
    question.choices.push_back(text);
  } while (!line_.failed() && line_.accept(","));
}

// Parses "1 TO 40", "0 TO length STEP 0.5"
void FlowReader::range(JobQuestion& question) {
  const JobToken from = line_.peek();
  std::vector<Formula> range;
  if (line_.at_end()) {
    line_.error(from, "expected the answers, CHOICE \"yes\", \"no\", or their range, 1 TO 40");
    return;
  }
  range.push_back(expressions_.formula("CHOICE, or the smallest answer"));
  if (!line_.failed() && !line_.accept("TO")) {
    line_.error(line_.peek(), "expected TO and the largest answer, found " + JobLine::shown(line_.peek()));
  }
  if (line_.failed()) {
    return;
  }
  range.push_back(expressions_.formula("the largest answer"));
  const auto lower = constant_of(range.front());
  const auto upper = constant_of(range.back());
  if (!line_.failed() && lower && upper && *lower > *upper) {
    line_.error(from, "no number is in this range; the smaller one comes first");
  }
  const JobToken step = line_.after();
  if (!line_.failed() && line_.accept("STEP") && line_.numbers(1, &question.step, "how far answers are apart") &&
      !(question.step > 0)) {
    line_.error(step, "answers are apart by more than 0; STEP 0.1");
  }
  question.lower = draft_.keep(std::move(range));
}

void FlowReader::call(int result) {
  draft_.add(Op::Call).mid = 0;
  draft_.last().slot = result;
  names_.refer(JobNames::To::Job, "job");
  std::vector<Formula> values;
  while (!line_.failed() && !line_.at_end()) {
    if (!values.empty() && !line_.accept(",")) {
      line_.error(line_.peek(), "expected ',' and another value, found " + JobLine::shown(line_.peek()));
      break;
    }
    values.push_back(expressions_.formula("a value"));
  }
  draft_.last().mid = static_cast<int>(values.size());
  draft_.last().formula = draft_.keep(std::move(values));
}

// Parses "RETURN", "RETURN n + 1"
void FlowReader::leave() {
  draft_.add(Op::Return);
  if (!line_.at_end()) {
    draft_.last().formula = expressions_.read("the value that the caller gets");
    draft_.job().returns_value = true;
  }
}

// Parses "RAISE 12", "RAISE 12, "there is no part""
void FlowReader::raise() {
  draft_.add(Op::Raise);
  const JobToken number = line_.peek();
  draft_.last().formula = expressions_.read("the number of the error");
  if (const auto known = draft_.constant(draft_.last().formula); !line_.failed() && known && !(*known > 0)) {
    line_.error(number, "RAISE takes the number of an error, above 0");
  }
  if (!line_.failed() && line_.accept(",")) {
    draft_.last().mid = text();
  }
}

void FlowReader::message() {
  draft_.add(Op::Message);
  draft_.last().mid = text();
}

int FlowReader::text() {
  JobText text;
  do {
    if (line_.peek().kind == JobToken::Kind::Text) {
      const std::string_view quoted = line_.take().text;
      text.parts.push_back({std::string(quoted.substr(1, quoted.size() - 2)), -1});
    } else {
      text.parts.push_back({"", expressions_.read("a text in quotes, or a number")});
    }
  } while (!line_.failed() && line_.accept(","));
  draft_.book().texts.push_back(std::move(text));
  return static_cast<int>(draft_.book().texts.size()) - 1;
}

void FlowReader::jump() {
  draft_.add(Op::Goto);
  names_.refer(JobNames::To::Label, "label");
}

void FlowReader::label() {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, "expected the name of the label, found " + JobLine::shown(name));
    return;
  }
  names_.label(name);
}

void FlowReader::arm() {
  const JobToken start = line_.peek();
  const int formula = expressions_.read("a condition");
  const Formula& condition = draft_.book().formulas.back();
  const bool of_job = condition.reads().variables || condition.reads().robot || condition.reads().places;
  if (!line_.failed() && (of_job || !condition.reads().signals)) {
    line_.error(start,
                "an interrupt monitors shared variables: no variables of the job, no places, no TIME and TIPSPEED");
  } else if (!line_.failed() && condition.size() > kMaxParts) {
    line_.error(start, "this condition is too long to be watched; have a PLC program compute it");
  } else if (!line_.failed() && !line_.accept("CALL")) {
    line_.error(line_.peek(),
                "expected CALL and the name of a job, found " + JobLine::shown(line_.peek()) + "; ON I4 CALL eject");
  } else if (!line_.failed() && draft_.book().interrupts.size() >= kMaxInterrupts) {
    line_.error(line_.first(),
                "there are more than " + std::to_string(kMaxInterrupts) +
                    " ON in these jobs; have a PLC program join their conditions, or call one job for several");
  }
  Step& step = draft_.add(Op::Arm);
  step.formula = formula;
  step.mid = 0;
  step.slot = static_cast<int>(draft_.book().interrupts.size());
  if (line_.failed()) {
    return;
  }
  draft_.book().interrupts.push_back({formula, -1});
  names_.refer(JobNames::To::Job, "job");
  priority();
}

// Parses "PRIORITY 1" of the ON that was added to the book last.
void FlowReader::priority() {
  constexpr int kLast = JobBook::Interrupt::kLast;
  auto& all = draft_.book().interrupts;
  const JobToken start = line_.peek();
  if (!line_.failed() && line_.accept("PRIORITY")) {
    const JobToken number = line_.peek();
    double priority = 0;
    if (line_.numbers(1, &priority, "the number of the priority") &&
        (priority != std::floor(priority) || priority < 1 || priority >= kLast)) {
      line_.error(number,
                  "a priority is a whole number from 1, which interrupts all others, to " + std::to_string(kLast - 1));
    }
    all.back().priority = line_.failed() ? kLast : static_cast<int>(priority);
  }
  std::set<int> different;
  for (const auto& each : all) {
    different.insert(each.priority);
  }
  if (different.size() > kMaxPriorities) {
    std::string numbers;
    for (const int each : different) {
      numbers += (numbers.empty() ? "" : ", ") + (each == kLast ? std::string("none") : std::to_string(each));
    }
    line_.error(start, "the ON of these jobs have more than " + std::to_string(kMaxPriorities) +
                           " different priorities: " + numbers + "; none comes after all others, and counts as well");
    all.back().priority = all.front().priority;
  }
}

void FlowReader::disarm() {
  if (!line_.accept("CALL")) {
    line_.error(line_.peek(),
                "expected CALL and the name of a job, found " + JobLine::shown(line_.peek()) + "; OFF CALL eject");
    return;
  }
  draft_.add(Op::Disarm);
  names_.refer(JobNames::To::Job, "job");
}

}  // namespace indurop::robot
