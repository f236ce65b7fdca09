// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/blocks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace indurop::robot {

const char* BlockReader::word_of(Kind kind) noexcept {
  switch (kind) {
    case Kind::If:
      return "IF";
    case Kind::While:
      return "WHILE";
    case Kind::For:
      return "FOR";
    case Kind::Loop:
      return "LOOP";
    case Kind::Switch:
      return "SWITCH";
    case Kind::Wait:
      return "WAIT ... ELSE";
    case Kind::Ask:
      return "ASK ... ELSE";
    case Kind::Try:
      break;
  }
  return "TRY";
}

bool BlockReader::repeats(Kind kind) noexcept {
  return kind == Kind::While || kind == Kind::For || kind == Kind::Loop;
}

BlockReader::Block& BlockReader::open(Kind kind, std::size_t start, std::size_t pending) {
  Block block;
  block.kind = kind;
  block.line = line_.number();
  block.start = start;
  block.pending = pending;
  blocks_.push_back(std::move(block));
  return blocks_.back();
}

// The part before ends; where it does not run, the next step does.
void BlockReader::begin_part(Block& block) {
  block.ends.push_back(draft_.next());
  draft_.add(Op::Again);
  if (block.pending != kNone) {
    draft_.step(block.pending).index = static_cast<int>(draft_.next());
  }
  block.pending = kNone;
}

int BlockReader::hidden_variable(const JobToken& at) {
  if (draft_.job().variables.size() >= kMaxVariables) {
    line_.error(at, "more than " + std::to_string(kMaxVariables) + " variables; split the job and use CALL");
    return -1;
  }
  return draft_.add_hidden();
}

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
  open(Kind::If, draft_.next() - 1, draft_.next() - 1);
}

void BlockReader::otherwise(bool condition) {
  if (!is_in(Kind::If) || blocks_.back().has_else) {
    line_.error(line_.first(), std::string(condition ? "ELSEIF" : "ELSE") + " without IF");
    return;
  }
  Block& block = blocks_.back();
  begin_part(block);
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
  open(Kind::While, start, start);
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
  const int limit = line_.failed() ? -1 : hidden_variable(name);
  if (limit < 0) {
    return;
  }
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
  Block& block = open(Kind::For, start, start);
  block.counter = counter;
  block.by = by;
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
  const auto loops =
      std::count_if(blocks_.begin(), blocks_.end(), [](const Block& block) { return block.kind == Kind::Loop; });
  if (static_cast<std::size_t>(loops) >= kMaxLoops) {
    line_.error(line_.first(), "at most " + std::to_string(kMaxLoops) + " LOOPs inside each other; use CALL");
  }
  open(Kind::Loop, draft_.next() - 1, kNone);
}

void BlockReader::exit() {
  const auto loop =
      std::find_if(blocks_.rbegin(), blocks_.rend(), [](const Block& block) { return repeats(block.kind); });
  if (loop == blocks_.rend()) {
    line_.error(line_.first(), "EXIT without LOOP, WHILE or FOR; RETURN leaves the job");
    return;
  }
  loop->ends.push_back(draft_.next());
  draft_.add(Op::Goto);
}

// Parses "SWITCH n", which CASE, DEFAULT and END follow.
void BlockReader::switch_block() {
  const int formula = expressions_.read("the value to choose by");
  const int value = line_.failed() ? -1 : hidden_variable(line_.first());
  Step& step = draft_.add(Op::Assign);
  step.index = value;
  step.formula = formula;
  open(Kind::Switch, draft_.next(), kNone).counter = value;
}

// Parses "CASE 1, 2"
void BlockReader::case_of() {
  if (!is_in(Kind::Switch) || blocks_.back().has_else) {
    line_.error(line_.first(),
                is_in(Kind::Switch) ? "CASE after DEFAULT, which is the last one" : "CASE without SWITCH");
    return;
  }
  Block& block = blocks_.back();
  if (block.pending != kNone) {
    begin_part(block);
  } else if (draft_.next() != block.start) {
    line_.error(line_.first(), "a statement between SWITCH and the first CASE is never executed; put it elsewhere");
  }
  Formula matches;
  for (bool first = true; !line_.failed() && (first || line_.accept(",")); first = false) {
    Formula one = Formula::joined(Formula::variable(block.counter), expressions_.formula("a value"), FormulaOp::Equal);
    matches = first ? std::move(one) : Formula::joined(std::move(matches), one, FormulaOp::Or);
  }
  if (!line_.failed() && !matches.fits()) {
    line_.error(line_.first(), "too many values in one CASE; use several");
  }
  block.pending = draft_.next();
  draft_.add(Op::Unless).formula = draft_.keep(std::move(matches));
}

void BlockReader::case_default() {
  if (!is_in(Kind::Switch) || blocks_.back().has_else || blocks_.back().pending == kNone) {
    line_.error(line_.first(), "DEFAULT comes once, after the CASEs of a SWITCH");
    return;
  }
  begin_part(blocks_.back());
  blocks_.back().has_else = true;
}

void BlockReader::timeout_else() {
  if (line_.failed()) {
    return;
  }
  if (!line_.accept("ELSE")) {
    if (draft_.last().op == Op::WaitUntil && draft_.last().timeout > 0 && draft_.is_never(draft_.last().formula)) {
      line_.error(line_.first(), "this condition is never true, so the WAIT always fails; WAIT 2s waits for a time");
    }
    return;
  }
  const std::size_t wait = draft_.next() - 1;
  const Op op = draft_.last().op;
  if (op == Op::WaitTime || !(draft_.last().timeout > 0)) {
    line_.error(line_.before(), std::string("ELSE follows a time, ") +
                                    (op == Op::Ask ? "TIMEOUT 30s ELSE; an ASK" : "WAIT I4 TIMEOUT 2s ELSE; a WAIT") +
                                    " without one waits for ever");
    return;
  }
  begin_part(open(op == Op::Ask ? Kind::Ask : Kind::Wait, wait, wait));
}

void BlockReader::try_block() {
  const std::size_t start = draft_.next();
  draft_.add(Op::Try);
  open(Kind::Try, start, start);
}

void BlockReader::recover() {
  if (!is_in(Kind::Try) || blocks_.back().has_else) {
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
    line_.error(line_.first(), "END without LOOP, IF, WHILE, FOR, SWITCH or TRY");
    return;
  }
  const Block block = std::move(blocks_.back());
  blocks_.pop_back();
  if (block.kind == Kind::Try && !block.has_else) {
    line_.error_in(line_.file(), block.line, 1, "TRY without RECOVER");
    return;
  }
  if (block.kind == Kind::Loop) {
    draft_.add(Op::End).index = static_cast<int>(block.start);
    draft_.step(block.start).index = static_cast<int>(draft_.next());
  } else if (block.kind == Kind::For) {
    const int next =
        draft_.keep(Formula::joined(Formula::variable(block.counter), Formula::number(block.by), FormulaOp::Add));
    Step& step = draft_.add(Op::Assign);
    step.index = block.counter;
    step.formula = next;
  }
  if (block.kind == Kind::While || block.kind == Kind::For) {
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
    line_.error_in(line_.file(), block.line, 1, std::string(word_of(block.kind)) + " without END");
  }
}

}  // namespace indurop::robot
