// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/chart_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <utility>

#include "control/plc/model/elementary.h"

namespace indurop::plc::st {

using network::Body;
using Kind = network::Element::Kind;

bool ChartParser::at_chart() const {
  return in_.peek().is("INITIAL_STEP") || (in_.peek().is("STEP") && in_.peek(2).is(":"));
}

// Returns whether an operator of the list and its operand are next; in Structured Text no operand follows a name. Or a
// formal call on several lines that is followed by an operator, not by ';'.
bool ChartParser::at_instruction_list() const {
  if (in_.peek().kind == TokenKind::Word && in_.peek(1).is("(")) {
    constexpr std::size_t kLongest = 1000;
    std::size_t behind = 2;
    for (int depth = 1; depth > 0 && behind < kLongest && in_.peek(behind).kind != TokenKind::End; ++behind) {
      depth += in_.peek(behind).is("(") ? 1 : in_.peek(behind).is(")") ? -1 : 0;
    }
    const Token& word = in_.peek(behind);
    constexpr std::array<std::string_view, 26> kOperators{
        "LD",  "LDN", "ST",  "STN", "S",  "R",  "AND", "ANDN", "OR", "ORN", "XOR",  "XORN", "ADD",
        "SUB", "MUL", "DIV", "MOD", "GT", "GE", "EQ",  "NE",   "LE", "LT",  "JMPC", "CALC", "RETC"};
    return word.line > in_.peek(behind - 1).line && in_.peek(behind + 1).line == word.line &&
           std::any_of(kOperators.begin(), kOperators.end(), [&](std::string_view one) { return word.is(one); });
  }
  const Token& operand = in_.peek(1);
  return in_.next_is({"LD", "LDN", "CAL", "CALC", "CALCN"}) &&
         (operand.kind == TokenKind::Word || operand.kind == TokenKind::Number || operand.kind == TokenKind::Typed ||
          operand.kind == TokenKind::Address || operand.kind == TokenKind::Text);
}

WrittenBody ChartParser::instruction_list(std::string_view end) {
  out_.code.body = code_until(end, Body::Language::Il);
  return std::move(out_);
}

// Parses statements with ACTIONs before or after them.
WrittenBody ChartParser::statements(std::string_view end) {
  while (in_.accept("ACTION")) {
    take_action();
  }
  out_.code.body = code_until(end, Body::Language::St, "ACTION");
  WrittenBody made = std::move(out_);
  actions(made);
  if (!in_.at_end() && !in_.peek().is(end)) {
    in_.error(in_.peek(), "there are statements before and after an ACTION, put them together");
    while (!in_.at_end() && !in_.peek().is(end)) {
      in_.take();
    }
  }
  return made;
}

void ChartParser::actions(WrittenBody& to) {
  out_ = std::move(to);
  while (in_.accept("ACTION")) {
    take_action();
  }
  to = std::move(out_);
}

void ChartParser::take_action() {
  if (!action()) {
    in_.skip_behind("END_ACTION");
  }
  in_.accept(";");
}

WrittenBody ChartParser::chart(std::string_view end) {
  out_.code.body.language = Body::Language::Sfc;
  out_.code.body.at = in_.here();
  while (!in_.at_end() && !in_.peek().is(end)) {
    bool fine = false;
    if (in_.accept("INITIAL_STEP")) {
      fine = step(true);
    } else if (in_.accept("STEP")) {
      fine = step(false);
    } else if (in_.accept("TRANSITION")) {
      fine = transition();
    } else {
      fine = in_.expect("ACTION", "or STEP or TRANSITION") && action();
    }
    if (!fine) {
      while (!in_.at_end() && !in_.next_is({"END_STEP", "END_TRANSITION", "END_ACTION", end})) {
        in_.take();
      }
      if (!in_.peek().is(end)) {
        in_.take();
      }
    }
    in_.accept(";");
  }
  for (const Transition& each : transitions_) {
    connect(each);
  }
  return std::move(out_);
}

network::Element& ChartParser::add(Kind kind, const Place& at) {
  network::Element& made = out_.code.body.diagram.elements.emplace_back();
  made.kind = kind;
  made.at = at;
  made.id = out_.code.body.diagram.elements.size();
  made.inputs.emplace_back().at = at;
  return made;
}

void ChartParser::lead(Element& to, std::uint64_t from) {
  to.inputs.front().connections.push_back({to.at, from, "", {}});
}

// name: action(N); ... END_STEP
bool ChartParser::step(bool initial) {
  if (!in_.expect_name("a step")) {
    return false;
  }
  const Token& name = in_.take();
  const Place at = in_.place(name);
  Element& made = add(Kind::Step, at);
  made.text = name.text;
  made.initial = initial;
  const std::uint64_t id = made.id;
  steps_.emplace(upper(name.text), out_.code.body.diagram.elements.size() - 1);
  if (!in_.expect(":", "after the name of the step")) {
    return false;
  }
  Element block;
  while (!in_.at_end() && !in_.peek().is("END_STEP")) {
    if (!action_line(block)) {
      return false;
    }
  }
  if (!block.actions.empty()) {
    Element& made_block = add(Kind::ActionBlock, at);
    made_block.actions = std::move(block.actions);
    lead(made_block, id);
  }
  return in_.expect("END_STEP", fmt::format("to close the step {}", name.text));
}

// name(qualifier, duration, indicators);
bool ChartParser::action_line(Element& block) {
  if (!in_.expect_name("an action")) {
    return false;
  }
  network::ActionLine line;
  line.at = in_.here();
  line.name = in_.take().text;
  while (in_.accept(".")) {  // of an instance: Valve.Open
    if (!in_.expect_name("an action")) {
      return false;
    }
    line.name += "." + std::string(in_.take().text);
  }
  if (!in_.expect("(", "after the name of the action")) {
    return false;
  }
  if (in_.peek().kind == TokenKind::Word) {
    line.qualifier = upper(in_.take().text);
  }
  for (bool first = true; in_.accept(","); first = false) {
    const Token& token = in_.take();  // indicators after the duration do not affect execution
    line.duration = first ? std::string(token.text) : line.duration;
  }
  block.actions.push_back(std::move(line));
  return in_.expect(")", "after the qualifier") && in_.expect(";", "after the action");
}

bool ChartParser::action() {
  if (!in_.expect_name("an action")) {
    return false;
  }
  network::NamedBody made;
  made.at = in_.here();
  made.name = in_.take().text;
  in_.accept(":");   // TwinCAT has none
  if (at_chart()) {  // a separate chart, whose actions are those of the POU
    WrittenBody inner = ChartParser(in_).chart("END_ACTION");
    made.body = std::move(inner.code.body);
    std::move(inner.code.actions.begin(), inner.code.actions.end(), std::back_inserter(out_.code.actions));
  } else {
    made.body = code_until("END_ACTION", at_instruction_list() ? Body::Language::Il : Body::Language::St);
  }
  out_.code.actions.push_back(std::move(made));
  return in_.expect("END_ACTION", "to close the ACTION");
}

// name (PRIORITY := 1) FROM a TO b := condition; END_TRANSITION
bool ChartParser::transition() {
  Transition made;
  made.at = in_.place(in_.previous());
  if (in_.peek().kind == TokenKind::Word && !in_.next_is({"FROM"})) {
    in_.take();
  }
  if (in_.accept("(")) {
    const bool fine = in_.expect("PRIORITY", "of the transition") && in_.expect(":=", "after PRIORITY");
    const std::string_view digits = fine ? in_.take().text : std::string_view();
    std::from_chars(digits.data(), digits.data() + digits.size(), made.priority);
    if (!fine || !in_.expect(")", "after the priority")) {
      return false;
    }
  }
  if (!in_.expect("FROM", "before the step") || !steps(made.from) || !in_.expect("TO", "before the next step") ||
      !steps(made.to)) {
    return false;
  }
  const bool list = in_.accept(":");
  if (!list && !in_.expect(":=", "before the condition")) {
    return false;
  }
  made.condition = std::make_shared<Body>(code_until("END_TRANSITION", list ? Body::Language::Il : Body::Language::St));
  transitions_.push_back(std::move(made));
  return in_.expect("END_TRANSITION", "to close the TRANSITION");
}

bool ChartParser::steps(std::vector<const Token*>& into) {
  const bool several = in_.accept("(");
  do {
    if (!in_.expect_name("a step")) {
      return false;
    }
    into.push_back(&in_.take());
  } while (several && in_.accept(","));
  return !several || in_.expect(")", "after the steps");
}

// Returns the text up to the word, or the other one.
network::Body ChartParser::code_until(std::string_view end, Body::Language language, std::string_view other) {
  Body body;
  body.language = language;
  body.at = in_.here();
  body.text_at = body.at;
  const char* first = nullptr;
  const char* last = nullptr;
  while (!in_.at_end() && !in_.peek().is(end) && (other.empty() || !in_.peek().is(other))) {
    const Token& one = in_.take();
    first = first == nullptr ? one.written.data() : first;
    last = one.written.data() + one.written.size();
  }
  if (first != nullptr) {
    body.text.assign(first, static_cast<std::size_t>(last - first));
  }
  return body;
}

network::Element* ChartParser::step_named(const Token& name) {
  const auto found = steps_.find(upper(name.text));
  if (found == steps_.end()) {
    in_.error(name, fmt::format("there is no step '{}'", name.text));
    return nullptr;
  }
  return &out_.code.body.diagram.elements[found->second];
}

// Builds the elements of the drawing: several steps before a transition meet in a convergence, several after it begin
// at a divergence.
void ChartParser::connect(const Transition& transition) {
  bool known = true;
  for (const auto* names : {&transition.from, &transition.to}) {
    for (const Token* name : *names) {
      known = step_named(*name) != nullptr && known;
    }
  }
  if (!known) {
    return;
  }
  std::vector<std::uint64_t> from;
  for (const Token* name : transition.from) {
    from.push_back(step_named(*name)->id);
  }
  std::uint64_t before = from.empty() ? 0 : from.front();
  if (from.size() > 1) {
    Element& meeting = add(Kind::SimultaneousConvergence, transition.at);
    for (const std::uint64_t step : from) {
      lead(meeting, step);
    }
    before = meeting.id;
  }
  Element& made = add(Kind::Transition, transition.at);
  made.priority = transition.priority;
  made.inlined = transition.condition;
  std::uint64_t behind = made.id;
  if (before != 0) {
    lead(made, before);
  }
  if (transition.to.size() > 1) {
    Element& beginning = add(Kind::SimultaneousDivergence, transition.at);
    lead(beginning, behind);
    behind = beginning.id;
  }
  for (const Token* name : transition.to) {
    lead(*step_named(*name), behind);
  }
}

}  // namespace indurop::plc::st
