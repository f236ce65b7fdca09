// SPDX-License-Identifier: Apache-2.0
// What expressions are made of: numbers, brackets, functions, variables and places.

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "control/robot/job/constants.h"
#include "control/robot/job/expression.h"
#include "control/robot/job/place_formulas.h"

namespace indurop::robot {

namespace {

struct Function {
  const char* name;
  FormulaOp op;
  int values;  // that it takes; 0: two or more
};
constexpr std::array<Function, 13> kFunctions{{{"ABS", FormulaOp::Abs, 1},
                                               {"SQRT", FormulaOp::Sqrt, 1},
                                               {"SIN", FormulaOp::Sin, 1},
                                               {"COS", FormulaOp::Cos, 1},
                                               {"TAN", FormulaOp::Tan, 1},
                                               {"ASIN", FormulaOp::Asin, 1},
                                               {"ACOS", FormulaOp::Acos, 1},
                                               {"ATAN", FormulaOp::Atan, 1},
                                               {"ATAN2", FormulaOp::Atan2, 2},
                                               {"ROUND", FormulaOp::Round, 1},
                                               {"TRUNC", FormulaOp::Trunc, 1},
                                               {"MIN", FormulaOp::Min, 0},
                                               {"MAX", FormulaOp::Max, 0}}};
struct PlaceFunction {
  const char* name;
  Coordinate which;
};
constexpr std::array<PlaceFunction, 7> kPlaceFunctions{{{"X", Coordinate::X},
                                                        {"Y", Coordinate::Y},
                                                        {"Z", Coordinate::Z},
                                                        {"ROLL", Coordinate::Roll},
                                                        {"PITCH", Coordinate::Pitch},
                                                        {"YAW", Coordinate::Yaw},
                                                        {"DIST", Coordinate::Distance}}};

}  // namespace

Formula ExpressionReader::operand(const char* what, int depth) {
  constexpr int kMaxBrackets = 10;
  if (depth > kMaxBrackets) {
    line_.error(line_.peek(), "more than " + std::to_string(kMaxBrackets) + " brackets inside each other");
    return {};
  }
  if (line_.accept("-")) {
    Formula formula = operand("a number", depth + 1);
    formula.push({FormulaOp::Negate, -1, 0});
    return formula;
  }
  if (line_.accept("(")) {
    return in_brackets(depth);
  }
  if (line_.peek().kind == JobToken::Kind::Number) {
    double value = 0;
    line_.numbers(1, &value, what);
    return Formula::number(value);
  }
  if (line_.accept("ON")) {
    return Formula::number(1);
  }
  if (line_.accept("OFF")) {
    return Formula::number(0);
  }
  if (line_.peek().kind != JobToken::Kind::Word || is_reserved(line_.peek().text)) {
    line_.error(line_.peek(), std::string("expected ") + what + ", found " + JobLine::shown(line_.peek()));
    return {};
  }
  return line_.after().text == "(" ? function(depth) : named(depth);
}

// Parses the rest of "(...)".
Formula ExpressionReader::in_brackets(int depth) {
  Formula formula = disjunction("a value", depth + 1);
  if (!line_.failed() && !line_.accept(")")) {
    line_.error(line_.peek(), "expected ')', found " + JobLine::shown(line_.peek()));
  }
  return formula;
}

// Parses "SQRT(x)", "MAX(a, b, c)".
Formula ExpressionReader::function(int depth) {
  const JobToken name = line_.take();
  line_.take();
  for (const PlaceFunction& each : kPlaceFunctions) {
    if (line_.is_word(name, each.name)) {
      return coordinate(each.which);
    }
  }
  const auto* const found = std::find_if(kFunctions.begin(), kFunctions.end(),
                                         [&](const Function& each) { return line_.is_word(name, each.name); });
  if (found == kFunctions.end()) {
    std::string names;
    for (const Function& each : kFunctions) {
      names += std::string(each.name) + ", ";
    }
    for (const PlaceFunction& each : kPlaceFunctions) {
      names += std::string(each.which == Coordinate::X ? "" : ", ") + each.name;
    }
    line_.error(name, "there is no function " + in_quotes(name.text) + "; known are " + names);
    return {};
  }
  Formula formula = disjunction("a value", depth + 1);
  int values = 1;
  for (; !line_.failed() && line_.accept(","); ++values) {
    formula = Formula::joined(std::move(formula), disjunction("a value", depth + 1), found->op);
  }
  if (found->values == 1) {
    formula.push({found->op, -1, 0});
  }
  if (!line_.failed() && !line_.accept(")")) {
    line_.error(line_.peek(), "expected ')', found " + JobLine::shown(line_.peek()));
  } else if (!line_.failed() && (found->values == 0 ? values < 2 : values != found->values)) {
    const char* const wanted = found->values == 0   ? "two values or more"
                               : found->values == 1 ? "one value"
                                                    : "two values";
    line_.error(name, std::string(found->name) + " takes " + wanted + ", here " +
                          (values == 1 ? "is 1" : "are " + std::to_string(values)));
  }
  check_constant(formula, name, line_);
  return formula;
}

// Parses the rest of "X(P)", "DIST(P, HERE)".
Formula ExpressionReader::coordinate(Coordinate which) {
  const int place = which == Coordinate::Distance ? places_->read_difference() : places_->read();
  if (!line_.failed() && !line_.accept(")")) {
    line_.error(line_.peek(), "expected ')', found " + JobLine::shown(line_.peek()));
  }
  if (line_.failed()) {
    return {};
  }
  Formula formula;
  formula.push({FormulaOp::Coordinate, place, static_cast<double>(which)});
  formula.also_reads(draft_.book().places[static_cast<std::size_t>(place)].reads);
  return formula;
}

// Parses "n", "a[i]", "TIME", "TIPSPEED", "FOUND", "I4", "I4 ON", "I4 OFF"
Formula ExpressionReader::named(int depth) {
  Formula formula;
  if (at_variable()) {
    Place known = place(depth);
    if (known.size > 0) {
      formula = std::move(known.element);
      formula.push({FormulaOp::Element, known.variable, static_cast<double>(known.size)});
    } else {
      formula = Formula::variable(known.variable);
    }
  } else if (line_.accept("TIME")) {
    formula.push({FormulaOp::Time, -1, 0});
  } else if (line_.accept("TIPSPEED")) {
    formula.push({FormulaOp::TipSpeed, -1, 0});
  } else if (line_.accept("FOUND")) {
    formula.push({FormulaOp::Found, -1, 0});
  } else {
    const JobToken name = line_.peek();
    formula.push({FormulaOp::Signal, signal("the name of a variable", Use::Read), 0});
    if (line_.peek().text == "[") {
      line_.error(line_.peek(), "the number of an element of a shared variable is written as " +
                                    std::string(name.text) + "[3], not computed");
    }
  }
  if (line_.failed()) {
    return {};
  }
  if (line_.accept("ON")) {
    return Formula::joined(std::move(formula), Formula::number(0), FormulaOp::NotEqual);
  }
  if (line_.accept("OFF")) {
    return Formula::joined(std::move(formula), Formula::number(0), FormulaOp::Equal);
  }
  return formula;
}

}  // namespace indurop::robot
