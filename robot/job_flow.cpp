// SPDX-License-Identifier: Apache-2.0
// Statements of a job that do not move the arm: signals, waiting, jumps and loops.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "robot/job_parser.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kDeepest = 8;

}  // namespace

bool holds(Compare compare, double left, double right) noexcept {
  switch (compare) {
    case Compare::Equal:
      return left == right;
    case Compare::NotEqual:
      return left != right;
    case Compare::Less:
      return left < right;
    case Compare::LessEqual:
      return left <= right;
    case Compare::Greater:
      return left > right;
    case Compare::GreaterEqual:
      return left >= right;
  }
  return false;
}

int JobParser::signal(const char* what) {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word) {
    error(name, std::string("expected ") + what + ", found " + shown(name));
    return -1;
  }
  const auto found = std::find(book_.signals.begin(), book_.signals.end(), name.text);
  if (found == book_.signals.end()) {
    book_.signals.emplace_back(name.text);
    return static_cast<int>(book_.signals.size()) - 1;
  }
  return static_cast<int>(found - book_.signals.begin());
}

void JobParser::set() {
  const int index = signal("the name of a variable");
  accept("=");
  double value = 1;
  if (accept("OFF")) {
    value = 0;
  } else if (!accept("ON") && !numbers(1, &value, "ON, OFF or the value")) {
    return;
  }
  Step& step = add(Op::Set);
  step.index = index;
  step.value = value;
}

// "I2", "I2 ON", "I2 OFF", "I2 >= 5"
void JobParser::condition(Step& step, int& index) {
  static constexpr std::pair<const char*, Compare> kSigns[] = {
      {"=", Compare::Equal}, {"==", Compare::Equal},     {"!=", Compare::NotEqual}, {"<>", Compare::NotEqual},
      {"<", Compare::Less},  {"<=", Compare::LessEqual}, {">", Compare::Greater},   {">=", Compare::GreaterEqual},
  };
  index = signal("the name of a variable");
  step.compare = Compare::NotEqual;
  step.value = 0;
  if (failed_ || accept("ON")) {
    return;
  }
  if (accept("OFF")) {
    step.compare = Compare::Equal;
    return;
  }
  for (const auto& [sign, compare] : kSigns) {
    if (accept(sign)) {
      step.compare = compare;
      const bool on = accept("ON");
      if (on || accept("OFF")) {
        step.value = on ? 1 : 0;
      } else {
        numbers(1, &step.value, "the value to compare with");
      }
      return;
    }
  }
}

bool JobParser::duration(double& seconds) {
  const JobToken number = peek();
  if (!numbers(1, &seconds, "a time, 0.5s or 200 ms")) {
    return false;
  }
  const bool ms = accept("ms");
  if (!ms && !accept("s")) {
    error(peek(), "expected s or ms, found " + shown(peek()));
    return false;
  }
  seconds = ms ? seconds / 1000 : seconds;
  if (!(seconds >= 0 && seconds <= 86400)) {
    error(number, "a time is from 0 to 86400 s");
    return false;
  }
  return true;
}

void JobParser::wait() {
  if (peek().kind == JobToken::Kind::Number) {
    double seconds = 0;
    if (duration(seconds)) {
      add(Op::WaitTime).value = seconds;
    }
    return;
  }
  Step step;
  condition(step, step.index);
  if (!failed_ && accept("TIMEOUT")) {
    duration(step.timeout);
  }
  Step& added = add(Op::WaitSignal);
  step.op = added.op;
  step.line = added.line;
  added = step;
}

void JobParser::jump(Op op) {
  add(op);
  const bool call = op == Op::Call;
  reference(call ? JobReference::To::Job : JobReference::To::Label, call ? "job" : "label");
}

void JobParser::if_goto() {
  Step step;
  condition(step, step.mid);
  if (!failed_ && !accept("GOTO")) {
    error(peek(), "expected GOTO and a label, found " + shown(peek()));
    return;
  }
  Step& added = add(Op::If);
  step.op = added.op;
  step.line = added.line;
  added = step;
  if (!failed_) {
    reference(JobReference::To::Label, "label");
  }
}

void JobParser::label() {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word) {
    error(name, "expected the name of the label, found " + shown(name));
    return;
  }
  const auto [found, fresh] = labels_.back().try_emplace(std::string(name.text), JobLabel{job().steps.size(), line_});
  if (!fresh) {
    error(name, "there is already a label " + in_quotes(name.text) + " in line " + std::to_string(found->second.line));
  }
}

void JobParser::loop() {
  Step& step = add(Op::Loop);
  if (peek().kind == JobToken::Kind::Number) {
    const JobToken times = take();
    step.value = times.value;
    if (!(times.value >= 1 && times.value <= 1e9 && times.value == std::floor(times.value))) {
      error(times, "a LOOP runs a whole number of times, from 1; without a number it runs for ever");
    }
  }
  if (loops_.size() >= kDeepest) {
    error(tokens_[0], "at most " + std::to_string(kDeepest) + " LOOPs inside each other; use CALL");
  }
  loops_.push_back(job().steps.size() - 1);
}

void JobParser::end_loop() {
  if (loops_.empty()) {
    error(tokens_[0], "END without LOOP");
    return;
  }
  const std::size_t start = loops_.back();
  loops_.pop_back();
  add(Op::End).index = static_cast<int>(start);
  job().steps[start].index = static_cast<int>(job().steps.size());
}

}  // namespace indurop::robot
