// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/blocks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace indurop::robot {

// Parses "IF ... GOTO label" in one line, or the beginning of a block.
void BlockReader::if_goto() {
  const int formula = expressions_.read("a condition");
  if (line_.failed()) {
    return;
  }
  const bool jumps = line_.accept("GOTO");
  draft_.add(jumps ? Op::If : Op::Unless).formula = formula;
  if (jumps) {
    names_.refer(JobNames::To::Label, "label");
    return;
  }
  blocks_.push_back({"IF", line_.number(), draft_.next() - 1, draft_.next() - 1, {}, -1, 1, false});
}

void BlockReader::otherwise(bool condition) {
  if (blocks_.empty() || std::string_view(blocks_.back().word) != "IF" || blocks_.back().has_else) {
    line_.error(line_.first(), std::string(condition ? "ELSEIF" : "ELSE") + " without IF");
    return;
  }
  Block& block = blocks_.back();
  block.ends.push_back(draft_.next());
  draft_.add(Op::Again);
  draft_.step(block.pending).index = static_cast<int>(draft_.next());
  block.pending = kNone;
  block.has_else = !condition;
  if (condition) {
    const int formula = expressions_.read("a condition");
    block.pending = draft_.next();
    draft_.add(Op::Unless).formula = formula;
  }
}

void BlockReader::while_block() {
  const int formula = expressions_.read("a condition");
  const std::size_t start = draft_.next();
  draft_.add(Op::Unless).formula = formula;
  blocks_.push_back({"WHILE", line_.number(), start, start, {}, -1, 1, false});
}

// Parses FOR i = first TO last STEP by
void BlockReader::for_block() {
  const JobToken name = line_.take();
  const int known = draft_.variable_called(name.text);
  if (!line_.accept("=")) {
    line_.error(line_.peek(), "expected '=', found " + JobLine::shown(line_.peek()) + "; FOR i = 1 TO 10");
    return;
  }
  const int first = expressions_.read("the first value");
  if (!line_.failed() && !line_.accept("TO")) {
    line_.error(line_.peek(), "expected TO and the last value, found " + JobLine::shown(line_.peek()));
  }
  const int last = line_.failed() ? -1 : expressions_.read("the last value");
  double by = 1;
  const JobToken step = line_.peek();
  if (!line_.failed() && line_.accept("STEP") && line_.numbers(1, &by, "how much further each time") && by == 0) {
    line_.error(step, "a FOR with STEP 0 would never end");
  }
  const int counter = line_.failed() ? -1 : known >= 0 ? known : expressions_.declare(name);
  if (line_.failed() || draft_.job().variables.size() >= kMaxVariables) {
    line_.error(name, "more than " + std::to_string(kMaxVariables) + " variables; split the job and use CALL");
    return;
  }
  const int limit = static_cast<int>(draft_.job().variables.size());
  draft_.job().variables.emplace_back();
  Step& begins = draft_.add(Op::Assign);
  begins.index = counter;
  begins.formula = first;
  Step& ends = draft_.add(Op::Assign);
  ends.index = limit;
  ends.formula = last;
  const std::size_t start = draft_.next();
  const FormulaOp goes_on = by > 0 ? FormulaOp::LessEqual : FormulaOp::GreaterEqual;
  draft_.add(Op::Unless).formula =
      draft_.keep(Formula::joined(Formula::variable(counter), Formula::variable(limit), goes_on));
  blocks_.push_back({"FOR", line_.number(), start, start, {}, counter, by, false});
}

void BlockReader::loop() {
  Step& step = draft_.add(Op::Loop);
  if (line_.peek().kind == JobToken::Kind::Number) {
    const JobToken times = line_.take();
    step.value = times.value;
    if (!(times.value >= 1 && times.value <= 1e9 && times.value == std::floor(times.value))) {
      line_.error(times, "a LOOP runs a whole number of times, from 1; without a number it runs for ever");
    }
  }
  const auto loops = std::count_if(blocks_.begin(), blocks_.end(),
                                   [](const Block& block) { return std::string_view(block.word) == "LOOP"; });
  if (static_cast<std::size_t>(loops) >= kMaxLoops) {
    line_.error(line_.first(), "at most " + std::to_string(kMaxLoops) + " LOOPs inside each other; use CALL");
  }
  blocks_.push_back({"LOOP", line_.number(), draft_.next() - 1, kNone, {}, -1, 1, false});
}

void BlockReader::try_block() {
  const std::size_t start = draft_.next();
  draft_.add(Op::Try);
  blocks_.push_back({"TRY", line_.number(), start, start, {}, -1, 1, false});
}

void BlockReader::recover() {
  if (blocks_.empty() || std::string_view(blocks_.back().word) != "TRY" || blocks_.back().has_else) {
    line_.error(line_.first(), "RECOVER without TRY");
    return;
  }
  constexpr const char* kNumber = "ERROR";
  const int known = draft_.variable_called(kNumber);
  const int number =
      known >= 0 ? known : expressions_.declare({JobToken::Kind::Word, kNumber, 0, line_.first().column});
  Block& block = blocks_.back();
  block.has_else = true;
  block.pending = kNone;
  block.ends.push_back(draft_.next());
  draft_.add(Op::EndTry);
  auto& steps = draft_.job().steps;
  for (std::size_t i = block.start + 1; i < steps.size(); ++i) {
    steps[i].guard = steps[i].guard < 0 ? static_cast<int>(block.start) : steps[i].guard;
  }
  steps[block.start].index = static_cast<int>(steps.size());
  steps[block.start].mid = number;
  draft_.add(Op::Recover);
}

void BlockReader::end_block() {
  if (blocks_.empty()) {
    line_.error(line_.first(), "END without LOOP, IF, WHILE, FOR or TRY");
    return;
  }
  const Block block = std::move(blocks_.back());
  blocks_.pop_back();
  const std::string_view word = block.word;
  if (word == "TRY" && !block.has_else) {
    line_.error_in(line_.file(), block.line, 1, "TRY without RECOVER");
    return;
  }
  if (word == "LOOP") {
    draft_.add(Op::End).index = static_cast<int>(block.start);
    draft_.step(block.start).index = static_cast<int>(draft_.next());
    return;
  }
  if (word == "FOR") {
    const int next =
        draft_.keep(Formula::joined(Formula::variable(block.counter), Formula::number(block.by), FormulaOp::Add));
    Step& step = draft_.add(Op::Assign);
    step.index = block.counter;
    step.formula = next;
  }
  if (word != "IF" && word != "TRY") {
    draft_.add(Op::Again).index = static_cast<int>(block.start);
  }
  const auto behind = static_cast<int>(draft_.next());
  if (block.pending != kNone) {
    draft_.step(block.pending).index = behind;
  }
  for (const std::size_t end : block.ends) {
    draft_.step(end).index = behind;
  }
}

void BlockReader::end() {
  for (const Block& block : blocks_) {
    line_.error_in(line_.file(), block.line, 1, std::string(block.word) + " without END");
  }
}

}  // namespace indurop::robot
