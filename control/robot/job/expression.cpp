// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/expression.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

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

bool ExpressionReader::is_reserved(std::string_view word) noexcept {
  return std::any_of(kReserved.begin(), kReserved.end(), [&](const char* each) { return same_word(word, each); });
}

int ExpressionReader::read(const char* what) {
  const JobToken start = line_.peek();
  Formula formula = disjunction(what, 0);
  if (!line_.failed() && !formula.fits()) {
    line_.error(start, "this expression is too long; compute a part of it before, in a VAR");
  }
  return draft_.keep(std::move(formula));
}

int ExpressionReader::signal(const char* what) {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, std::string("expected ") + what + ", found " + JobLine::shown(name));
    return -1;
  }
  const auto found = std::find(draft_.book().signals.begin(), draft_.book().signals.end(), name.text);
  if (found == draft_.book().signals.end()) {
    draft_.book().signals.emplace_back(name.text);
    draft_.book().named.push_back({std::string(name.text), line_.file(), line_.place(name)});
    return static_cast<int>(draft_.book().signals.size()) - 1;
  }
  return static_cast<int>(found - draft_.book().signals.begin());
}

int ExpressionReader::declare(const JobToken& name) {
  const bool plain = name.kind == JobToken::Kind::Word && name.text.find_first_of(".:[]") == std::string_view::npos;
  if (!plain || is_reserved(name.text)) {
    line_.error(name, "expected the name of a variable, letters and digits, found " + JobLine::shown(name));
    return -1;
  }
  if (draft_.variable_called(name.text) >= 0) {
    line_.error(name, "there is already a variable " + in_quotes(name.text));
    return -1;
  }
  if (draft_.job().variables.size() >= kMaxVariables) {
    line_.error(name, "more than " + std::to_string(kMaxVariables) + " variables; split the job and use CALL");
    return -1;
  }
  draft_.job().variables.emplace_back(name.text);
  return static_cast<int>(draft_.job().variables.size()) - 1;
}

Formula ExpressionReader::disjunction(const char* what, int depth) {
  Formula left = conjunction(what, depth);
  while (!line_.failed() && line_.accept("OR")) {
    left = Formula::joined(std::move(left), conjunction("a condition", depth), FormulaOp::Or);
  }
  return left;
}

Formula ExpressionReader::conjunction(const char* what, int depth) {
  Formula left = negation(what, depth);
  while (!line_.failed() && line_.accept("AND")) {
    left = Formula::joined(std::move(left), negation("a condition", depth), FormulaOp::And);
  }
  return left;
}

Formula ExpressionReader::negation(const char* what, int depth) {
  bool negated = false;
  while (line_.accept("NOT")) {
    negated = !negated;
    what = "a condition";
  }
  Formula formula = comparison(what, depth);
  if (negated) {
    formula.push({FormulaOp::Not, -1, 0});
  }
  return formula;
}

Formula ExpressionReader::comparison(const char* what, int depth) {
  Formula left = sum(what, depth);
  for (const Sign& sign : kComparisons) {
    if (!line_.failed() && line_.accept(sign.text)) {
      return Formula::joined(std::move(left), sum("what to compare with", depth), sign.op);
    }
  }
  return left;
}

Formula ExpressionReader::sum(const char* what, int depth) {
  Formula left = product(what, depth);
  while (!line_.failed()) {
    const bool signed_number = line_.peek().kind == JobToken::Kind::Number &&
                               (line_.peek().text.front() == '-' || line_.peek().text.front() == '+');
    if (signed_number || line_.accept("+")) {
      left = Formula::joined(std::move(left), product("a number", depth), FormulaOp::Add);  // "n -1"
    } else if (line_.accept("-")) {
      left = Formula::joined(std::move(left), product("a number", depth), FormulaOp::Subtract);
    } else {
      break;
    }
  }
  return left;
}

Formula ExpressionReader::product(const char* what, int depth) {
  Formula left = operand(what, depth);
  bool more = true;
  while (more && !line_.failed()) {
    more = false;
    for (const Sign& sign : kProducts) {
      if (line_.accept(sign.text)) {
        left = Formula::joined(std::move(left), operand("a number", depth), sign.op);
        more = true;
        break;
      }
    }
  }
  return left;
}

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
    Formula formula = disjunction("a value", depth + 1);
    if (!line_.failed() && !line_.accept(")")) {
      line_.error(line_.peek(), "expected ')', found " + JobLine::shown(line_.peek()));
    }
    return formula;
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
  return named();
}

// Parses "n", "I4", "I4 ON", "I4 OFF"
Formula ExpressionReader::named() {
  const int variable = draft_.variable_called(line_.peek().text);
  Formula formula;
  if (variable >= 0) {
    line_.take();
    formula = Formula::variable(variable);
  } else {
    formula.push({FormulaOp::Signal, signal("the name of a variable"), 0});
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
