// SPDX-License-Identifier: Apache-2.0
// Expressions of jobs, by precedence: OR, AND, NOT, comparison, sum, product, sign.
#include <algorithm>
#include <array>
#include <utility>

#include "control/robot/job/parser.h"

namespace indurop::robot {

namespace {

struct Sign {
  const char* text;
  FormulaOp op;
};

constexpr std::array<Sign, 8> kComparisons{{{"=", FormulaOp::Equal},
                                            {"==", FormulaOp::Equal},
                                            {"!=", FormulaOp::NotEqual},
                                            {"<>", FormulaOp::NotEqual},
                                            {"<", FormulaOp::Less},
                                            {"<=", FormulaOp::LessEqual},
                                            {">", FormulaOp::Greater},
                                            {">=", FormulaOp::GreaterEqual}}};
constexpr std::array<Sign, 3> kProducts{
    {{"*", FormulaOp::Multiply}, {"/", FormulaOp::Divide}, {"MOD", FormulaOp::Modulo}}};
constexpr std::array<const char*, 16> kReserved{"BEFORE", "AFTER", "AND",     "OR",   "NOT",  "MOD", "ON",    "OFF",
                                                "TO",     "STEP",  "TIMEOUT", "GOTO", "ELSE", "END", "PARAM", "VAR"};

}  // namespace

bool JobParser::is_reserved(std::string_view word) noexcept {
  return std::any_of(kReserved.begin(), kReserved.end(), [&](const char* each) { return same_word(word, each); });
}

int JobParser::expression(const char* what) {
  const JobToken start = peek();
  Formula formula = disjunction(what, 0);
  if (!failed_ && !formula.fits()) {
    error(start, "this expression is too long; compute a part of it before, in a VAR");
  }
  return keep(std::move(formula));
}

int JobParser::keep(Formula formula) {
  book_.formulas.push_back(std::move(formula));
  return static_cast<int>(book_.formulas.size()) - 1;
}

Formula JobParser::disjunction(const char* what, int depth) {
  Formula left = conjunction(what, depth);
  while (!failed_ && accept("OR")) {
    left = Formula::joined(std::move(left), conjunction("a condition", depth), FormulaOp::Or);
  }
  return left;
}

Formula JobParser::conjunction(const char* what, int depth) {
  Formula left = negation(what, depth);
  while (!failed_ && accept("AND")) {
    left = Formula::joined(std::move(left), negation("a condition", depth), FormulaOp::And);
  }
  return left;
}

Formula JobParser::negation(const char* what, int depth) {
  bool negated = false;
  while (accept("NOT")) {
    negated = !negated;
    what = "a condition";
  }
  Formula formula = comparison(what, depth);
  if (negated) {
    formula.push({FormulaOp::Not, -1, 0});
  }
  return formula;
}

Formula JobParser::comparison(const char* what, int depth) {
  Formula left = sum(what, depth);
  for (const Sign& sign : kComparisons) {
    if (!failed_ && accept(sign.text)) {
      return Formula::joined(std::move(left), sum("what to compare with", depth), sign.op);
    }
  }
  return left;
}

Formula JobParser::sum(const char* what, int depth) {
  Formula left = product(what, depth);
  while (!failed_) {
    const bool signed_number =
        peek().kind == JobToken::Kind::Number && (peek().text.front() == '-' || peek().text.front() == '+');
    if (signed_number || accept("+")) {
      left = Formula::joined(std::move(left), product("a number", depth), FormulaOp::Add);  // "n -1"
    } else if (accept("-")) {
      left = Formula::joined(std::move(left), product("a number", depth), FormulaOp::Subtract);
    } else {
      break;
    }
  }
  return left;
}

Formula JobParser::product(const char* what, int depth) {
  Formula left = operand(what, depth);
  bool more = true;
  while (more && !failed_) {
    more = false;
    for (const Sign& sign : kProducts) {
      if (accept(sign.text)) {
        left = Formula::joined(std::move(left), operand("a number", depth), sign.op);
        more = true;
        break;
      }
    }
  }
  return left;
}

Formula JobParser::operand(const char* what, int depth) {
  constexpr int kDeepest = 10;
  if (depth > kDeepest) {
    error(peek(), "more than " + std::to_string(kDeepest) + " brackets inside each other");
    return {};
  }
  if (accept("-")) {
    Formula formula = operand("a number", depth + 1);
    formula.push({FormulaOp::Negate, -1, 0});
    return formula;
  }
  if (accept("(")) {
    Formula formula = disjunction("a value", depth + 1);
    if (!failed_ && !accept(")")) {
      error(peek(), "expected ')', found " + shown(peek()));
    }
    return formula;
  }
  if (peek().kind == JobToken::Kind::Number) {
    double value = 0;
    numbers(1, &value, what);
    return Formula::number(value);
  }
  if (accept("ON")) {
    return Formula::number(1);
  }
  if (accept("OFF")) {
    return Formula::number(0);
  }
  if (peek().kind != JobToken::Kind::Word || is_reserved(peek().text)) {
    error(peek(), std::string("expected ") + what + ", found " + shown(peek()));
    return {};
  }
  return named();
}

// Parses "n", "I4", "I4 ON", "I4 OFF"
Formula JobParser::named() {
  const int variable = variable_called(peek().text);
  Formula formula;
  if (variable >= 0) {
    take();
    formula = Formula::variable(variable);
  } else {
    formula.push({FormulaOp::Signal, signal("the name of a variable"), 0});
  }
  if (accept("ON")) {
    return Formula::joined(std::move(formula), Formula::number(0), FormulaOp::NotEqual);
  }
  if (accept("OFF")) {
    return Formula::joined(std::move(formula), Formula::number(0), FormulaOp::Equal);
  }
  return formula;
}

}  // namespace indurop::robot
