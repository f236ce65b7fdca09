// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/place_formulas.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace indurop::robot {

namespace {

constexpr const char* kExpected =
    "expected POSE x, y, z RPY r, p, y, HERE, FOUND, WORLD, INV(...) or the name of a point or a frame, found ";
constexpr int kMostBrackets = 10;

}  // namespace

void PlaceFormulaReader::Draft::push(PlaceOp op, int index) {
  PlacePart part;
  part.op = op;
  part.index = index;
  parts.push_back(part);
  const bool is_place = op <= PlaceOp::Found;
  const bool joins = op == PlaceOp::Joined || op == PlaceOp::In;
  depth = depth + (is_place ? 1 : 0) - (joins ? 1 : 0);
  deepest = std::max(deepest, depth);
}

bool PlaceFormulaReader::at_place() const {
  const JobToken& next = line_.peek();
  const JobToken& then = line_.after();
  const bool alone = then.kind == JobToken::Kind::End || then.text == ":" || same_word(then.text, "IN");
  const bool begins = same_word(next.text, "POSE") || same_word(next.text, "INV");
  return next.kind == JobToken::Kind::Word && (begins || alone);
}

int PlaceFormulaReader::read() {
  const JobToken start = line_.peek();
  Draft draft;
  product(draft, 0);
  if (!line_.failed() && line_.accept("IN")) {
    name(draft);
    draft.push(PlaceOp::In);
  }
  return keep(draft, start);
}

int PlaceFormulaReader::read_difference() {
  const JobToken start = line_.peek();
  Draft draft;
  product(draft, 0);
  draft.push(PlaceOp::Inverse);
  if (!line_.failed() && !line_.accept(",")) {
    line_.error(line_.peek(), "expected ',' and the other place, found " + JobLine::shown(line_.peek()));
  }
  product(draft, 0);
  draft.push(PlaceOp::Joined);
  return keep(draft, start);
}

int PlaceFormulaReader::keep(Draft& draft, const JobToken& start) {
  if (!line_.failed() && draft.deepest > static_cast<std::size_t>(PlaceFormula::kMaxPlaces)) {
    line_.error(start, "this place is made of too many others; compute a part of it before, in a FRAME");
  }
  if (line_.failed()) {
    return -1;
  }
  JobBook& book = draft_.book();
  PlaceFormula formula;
  formula.first = book.place_parts.size();
  formula.count = draft.parts.size();
  formula.column = static_cast<unsigned>(start.column);
  formula.reads = draft.reads;
  for (const auto& [part, token] : draft.names) {
    names_.declare(JobNames::In::PlaceName, formula.first + part, token);
  }
  book.place_parts.insert(book.place_parts.end(), draft.parts.begin(), draft.parts.end());
  book.places.push_back(formula);
  return static_cast<int>(book.places.size()) - 1;
}

void PlaceFormulaReader::product(Draft& draft, int brackets) {
  factor(draft, brackets);
  while (!line_.failed() && line_.accept(":")) {
    factor(draft, brackets);
    draft.push(PlaceOp::Joined);
  }
}

void PlaceFormulaReader::factor(Draft& draft, int brackets) {
  const JobToken start = line_.peek();
  if (line_.failed()) {
    return;
  }
  const bool inverse = same_word(start.text, "INV") && line_.after().text == "(";
  if (inverse) {
    line_.take();
  }
  if (line_.accept("(")) {
    if (brackets >= kMostBrackets) {
      line_.error(start, "more than " + std::to_string(kMostBrackets) + " brackets inside each other");
      return;
    }
    product(draft, brackets + 1);
    if (!line_.failed() && !line_.accept(")")) {
      line_.error(line_.peek(), "expected ')', found " + JobLine::shown(line_.peek()));
    }
    if (inverse) {
      draft.push(PlaceOp::Inverse);
    }
  } else if (line_.accept("POSE")) {
    pose(draft);
  } else if (line_.accept("HERE")) {
    draft.push(PlaceOp::Here);
    draft.reads.robot = true;
  } else if (line_.accept("FOUND")) {
    draft.push(PlaceOp::Found);
  } else {
    name(draft);
  }
}

void PlaceFormulaReader::name(Draft& draft) {
  const JobToken token = line_.take();
  if (token.kind != JobToken::Kind::Word) {
    line_.error(token, kExpected + JobLine::shown(token));
    return;
  }
  draft.reads.robot = draft.reads.robot || same_word(token.text, kWorld);
  draft.names.push_back({draft.parts.size(), token});
  draft.push(PlaceOp::Named);
}

// Three numbers; without commas if they are written as numbers.
std::vector<Formula> PlaceFormulaReader::numbers(const char* what, Reads& reads) {
  std::vector<Formula> three;
  if (line_.numbers_ahead(3)) {
    double values[3] = {};
    line_.numbers(3, values, what);
    for (const double value : values) {
      three.push_back(Formula::number(value));
    }
  } else {
    three = expressions_.list(3, what, "POSE x, y, 0 RPY 0, 0, turn");
  }
  for (const Formula& each : three) {
    reads.add(each.reads());
  }
  return three;
}

void PlaceFormulaReader::pose(Draft& draft) {
  std::vector<Formula> six = numbers("x, y and z in mm", draft.reads);
  std::vector<Formula> turn;
  if (!line_.failed() && line_.accept("RPY")) {
    turn = numbers("roll, pitch and yaw in degrees", draft.reads);
  } else {
    turn.assign(3, Formula::number(0));
  }
  std::move(turn.begin(), turn.end(), std::back_inserter(six));
  draft.push(PlaceOp::Pose, line_.failed() ? -1 : draft_.keep(std::move(six)));
}

}  // namespace indurop::robot
