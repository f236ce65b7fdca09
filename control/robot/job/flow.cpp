// SPDX-License-Identifier: Apache-2.0
// Statements of a job that do not move the arm: signals, variables, waiting, jumps and blocks.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/robot/job/parser.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kDeepest = 8;

}  // namespace

int JobParser::signal(const char* what) {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word) {
    error(name, std::string("expected ") + what + ", found " + shown(name));
    return -1;
  }
  const auto found = std::find(book_.signals.begin(), book_.signals.end(), name.text);
  if (found == book_.signals.end()) {
    book_.signals.emplace_back(name.text);
    book_.named.push_back(
        {std::string(name.text), job().file, {static_cast<int>(line_), static_cast<int>(name.column)}});
    return static_cast<int>(book_.signals.size()) - 1;
  }
  return static_cast<int>(found - book_.signals.begin());
}

// Parses "PULSE O8 0.2s", "PULSE O8 200 ms BEFORE 50 mm"
void JobParser::pulse() {
  Step step;
  step.index = signal("the name of a variable");
  const JobToken time = peek();
  if (!failed_ && duration(step.pulse) && !(step.pulse > 0)) {
    error(time, "a pulse is longer than 0 s");
  }
  add_setting(step);
}

void JobParser::set() {
  Step step;
  step.index = signal("the name of a variable");
  accept("=");
  step.formula = failed_ ? -1 : expression("ON, OFF or the value");
  add_setting(step);
}

// Adds a setting that takes effect at rest, or during the motion before it.
void JobParser::add_setting(Step step) {
  const bool before = !failed_ && accept("BEFORE");
  if (before || (!failed_ && accept("AFTER"))) {
    step.mid = before ? 0 : 1;
    set_on_path(step);
    return;
  }
  Step& added = add(Op::Set);
  step.op = added.op;
  step.line = added.line;
  added = step;
}

// Parses "SET O8 ON BEFORE 50 mm", "SET O8 ON AFTER 0.2s"
void JobParser::set_on_path(Step wanted) {
  const auto& steps = job().steps;
  auto motion = steps.rbegin();
  while (motion != steps.rend() && motion->op == Op::SetOnPath) {
    ++motion;
  }
  if (motion == steps.rend() || motion->op != Op::Move) {
    error(tokens_[0], "BEFORE and AFTER are about the motion in the line above; there is none");
    return;
  }
  if (wanted.formula >= 0 && book_.formulas[static_cast<std::size_t>(wanted.formula)].looks_out()) {
    error(tokens_[0], "what is set on the way is computed before; it cannot look at shared variables");
    return;
  }
  const JobToken number = peek();
  const JobToken unit = tokens_[at_ + 1];
  if (same_word(unit.text, "mm") && numbers(1, &wanted.value, "a distance")) {
    accept("mm");
    wanted.value /= 1000;
    if (!(wanted.value >= 0)) {
      error(number, "a distance is from 0 mm");
    } else if (motion->move == Move::Joint) {
      error(number, "the way of a MOVJ has no distance; give a time, BEFORE 0.2s");
    }
  } else if (duration(wanted.timeout)) {
    wanted.timeout = std::max(wanted.timeout, 1e-6);
  }
  if (!failed_) {
    Step& step = add(Op::SetOnPath);
    wanted.op = step.op;
    wanted.line = step.line;
    step = wanted;
  }
}

int JobParser::variable_called(std::string_view name) const noexcept {
  const std::vector<std::string>& variables = book_.jobs.back().variables;
  const auto found = std::find(variables.begin(), variables.end(), name);
  return found == variables.end() ? -1 : static_cast<int>(found - variables.begin());
}

int JobParser::new_variable(const JobToken& name) {
  const bool plain = name.kind == JobToken::Kind::Word && name.text.find_first_of(".:[]") == std::string_view::npos;
  if (!plain || is_reserved(name.text)) {
    error(name, "expected the name of a variable, letters and digits, found " + shown(name));
    return -1;
  }
  if (variable_called(name.text) >= 0) {
    error(name, "there is already a variable " + in_quotes(name.text));
    return -1;
  }
  if (job().variables.size() >= kMostVariables) {
    error(name, "more than " + std::to_string(kMostVariables) + " variables; split the job and use CALL");
    return -1;
  }
  job().variables.emplace_back(name.text);
  return static_cast<int>(job().variables.size()) - 1;
}

void JobParser::variable() {
  const JobToken name = take();
  int formula = -1;
  if (accept("=")) {
    formula = expression("its value");  // which cannot read the variable itself
  }
  const int index = failed_ ? -1 : new_variable(name);
  Step& step = add(Op::Assign);
  step.index = index;
  step.formula = formula >= 0 ? formula : keep(Formula::number(0));
}

void JobParser::parameters() {
  if (!job().steps.empty() || !job().variables.empty()) {
    error(tokens_[0], "PARAM comes first in a job, once");
    return;
  }
  while (!failed_ && peek().kind != JobToken::Kind::End) {
    new_variable(take());
    accept(",");
  }
  job().parameters = job().variables.size();
}

void JobParser::assign() {
  const JobToken name = take();
  accept("=");
  const int index = variable_called(name.text);
  if (index < 0) {
    error(name, "this job has no variable " + in_quotes(name.text) + "; declare it, VAR " + std::string(name.text) +
                    " = 0, or write SET for a shared one");
  }
  const int formula = expression("its value");
  Step& step = add(Op::Assign);
  step.index = index;
  step.formula = formula;
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
  const int formula = expression("a condition");
  double timeout = 0;
  if (!failed_ && accept("TIMEOUT")) {
    duration(timeout);
  }
  Step& step = add(Op::WaitUntil);
  step.formula = formula;
  step.timeout = timeout;
}

void JobParser::call() {
  add(Op::Call).mid = 0;
  reference(JobReference::To::Job, "job");
  int count = 0;
  int first = -1;
  while (!failed_ && peek().kind != JobToken::Kind::End) {
    if (count > 0 && !accept(",")) {
      error(peek(), "expected ',' and another value, found " + shown(peek()));
      break;
    }
    const int formula = expression("a value");
    first = count++ == 0 ? formula : first;
  }
  job().steps.back().formula = first;
  job().steps.back().mid = count;
}

void JobParser::jump() {
  add(Op::Goto);
  reference(JobReference::To::Label, "label");
}

// Parses "IF ... GOTO label" in one line, or the beginning of a block.
void JobParser::if_goto() {
  const int formula = expression("a condition");
  if (failed_) {
    return;
  }
  const bool jumps = accept("GOTO");
  add(jumps ? Op::If : Op::Unless).formula = formula;
  if (jumps) {
    reference(JobReference::To::Label, "label");
    return;
  }
  blocks_.push_back({"IF", line_, job().steps.size() - 1, job().steps.size() - 1, {}, -1, 1, false});
}

void JobParser::otherwise(bool condition) {
  if (blocks_.empty() || std::string_view(blocks_.back().word) != "IF" || blocks_.back().has_else) {
    error(tokens_[0], std::string(condition ? "ELSEIF" : "ELSE") + " without IF");
    return;
  }
  Block& block = blocks_.back();
  block.ends.push_back(job().steps.size());
  add(Op::Again);
  job().steps[block.pending].index = static_cast<int>(job().steps.size());
  block.pending = kNone;
  block.has_else = !condition;
  if (condition) {
    const int formula = expression("a condition");
    block.pending = job().steps.size();
    add(Op::Unless).formula = formula;
  }
}

void JobParser::while_block() {
  const int formula = expression("a condition");
  const std::size_t start = job().steps.size();
  add(Op::Unless).formula = formula;
  blocks_.push_back({"WHILE", line_, start, start, {}, -1, 1, false});
}

// Parses FOR i = first TO last STEP by
void JobParser::for_block() {
  const JobToken name = take();
  const int known = variable_called(name.text);
  if (!accept("=")) {
    error(peek(), "expected '=', found " + shown(peek()) + "; FOR i = 1 TO 10");
    return;
  }
  const int first = expression("the first value");
  if (!failed_ && !accept("TO")) {
    error(peek(), "expected TO and the last value, found " + shown(peek()));
  }
  const int last = failed_ ? -1 : expression("the last value");
  double by = 1;
  const JobToken step = peek();
  if (!failed_ && accept("STEP") && numbers(1, &by, "how much further each time") && by == 0) {
    error(step, "a FOR with STEP 0 would never end");
  }
  const int counter = failed_ ? -1 : known >= 0 ? known : new_variable(name);
  if (failed_ || job().variables.size() >= kMostVariables) {
    error(name, "more than " + std::to_string(kMostVariables) + " variables; split the job and use CALL");
    return;
  }
  const int limit = static_cast<int>(job().variables.size());
  job().variables.emplace_back();
  Step& begins = add(Op::Assign);
  begins.index = counter;
  begins.formula = first;
  Step& ends = add(Op::Assign);
  ends.index = limit;
  ends.formula = last;
  const std::size_t start = job().steps.size();
  const FormulaOp goes_on = by > 0 ? FormulaOp::LessEqual : FormulaOp::GreaterEqual;
  add(Op::Unless).formula = keep(Formula::joined(Formula::variable(counter), Formula::variable(limit), goes_on));
  blocks_.push_back({"FOR", line_, start, start, {}, counter, by, false});
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
  const auto loops = std::count_if(blocks_.begin(), blocks_.end(),
                                   [](const Block& block) { return std::string_view(block.word) == "LOOP"; });
  if (static_cast<std::size_t>(loops) >= kDeepest) {
    error(tokens_[0], "at most " + std::to_string(kDeepest) + " LOOPs inside each other; use CALL");
  }
  blocks_.push_back({"LOOP", line_, job().steps.size() - 1, kNone, {}, -1, 1, false});
}

void JobParser::end_block() {
  if (blocks_.empty()) {
    error(tokens_[0], "END without LOOP, IF, WHILE, FOR or TRY");
    return;
  }
  const Block block = std::move(blocks_.back());
  blocks_.pop_back();
  const std::string_view word = block.word;
  if (word == "TRY" && !block.has_else) {
    error_in(job().file, block.line, 1, "TRY without RECOVER");
    return;
  }
  if (word == "LOOP") {
    add(Op::End).index = static_cast<int>(block.start);
    job().steps[block.start].index = static_cast<int>(job().steps.size());
    return;
  }
  if (word == "FOR") {
    const int next = keep(Formula::joined(Formula::variable(block.counter), Formula::number(block.by), FormulaOp::Add));
    Step& step = add(Op::Assign);
    step.index = block.counter;
    step.formula = next;
  }
  if (word != "IF" && word != "TRY") {
    add(Op::Again).index = static_cast<int>(block.start);
  }
  const auto behind = static_cast<int>(job().steps.size());
  if (block.pending != kNone) {
    job().steps[block.pending].index = behind;
  }
  for (const std::size_t end : block.ends) {
    job().steps[end].index = behind;
  }
}

}  // namespace indurop::robot
