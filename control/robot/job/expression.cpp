// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include "control/robot/job/constants.h"

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

// The name of "a[3]".
std::string_view without_index(std::string_view name) noexcept {
  return name.substr(0, name.find('['));
}

bool is_index(double number, int size) noexcept {
  return number >= 0 && number < size && number == std::floor(number);
}

// The number in "a[3]"; -1: it has none.
int index_in(std::string_view name) noexcept {
  const std::string_view digits = name.substr(std::min(name.find('[') + 1, name.size()));
  int index = -1;
  std::from_chars(digits.data(), digits.data() + digits.size(), index);
  return name.find('[') == std::string_view::npos ? -1 : index;
}

}  // namespace

bool ExpressionReader::is_reserved(std::string_view word) noexcept {
  return std::any_of(kReserved.begin(), kReserved.end(), [&](const char* each) { return same_word(word, each); });
}

Formula ExpressionReader::formula(const char* what) {
  const JobToken start = line_.peek();
  Formula formula = disjunction(what, 0);
  if (!line_.failed() && !formula.fits()) {
    line_.error(start, "this expression is too long; compute a part of it before, in a VAR");
  }
  formula.begin_at(start.column);
  return formula;
}

std::vector<Formula> ExpressionReader::list(int count, const char* what, const char* example) {
  std::vector<Formula> formulas;
  for (int i = 0; i < count && !line_.failed(); ++i) {
    // Without the comma "0 -50" would be one number.
    if (i > 0 && !line_.accept(",")) {
      line_.error(line_.peek(), "expected ',', found " + JobLine::shown(line_.peek()) + "; " + example);
      break;
    }
    formulas.push_back(formula(what));
  }
  return formulas;
}

int ExpressionReader::signal(const char* what, Use use) {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, std::string("expected ") + what + ", found " + JobLine::shown(name));
    return -1;
  }
  return draft_.signal(name, use == Use::Set);
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

int ExpressionReader::declare_array(const JobToken& name, int& size) {
  size = index_in(name.text);
  JobToken plain = name;
  plain.text = without_index(name.text);
  const int first = declare(plain);
  if (line_.failed()) {
    return -1;
  }
  const std::size_t free = kMaxVariables - static_cast<std::size_t>(first);
  if (size < 1 || static_cast<std::size_t>(size) > free) {
    line_.error(name, "an array has 1 element or more, and all variables of a job together are at most " +
                          std::to_string(kMaxVariables) + ", so there is room for " + std::to_string(free));
    return -1;
  }
  draft_.add_hidden(static_cast<std::size_t>(size) - 1);
  draft_.job().arrays.push_back({first, size});
  return first;
}

bool ExpressionReader::at_variable() const {
  return line_.peek().kind == JobToken::Kind::Word && draft_.variable_called(without_index(line_.peek().text)) >= 0;
}

ExpressionReader::Place ExpressionReader::place() {
  return place(0);
}

// Parses "n", "a[3]", "a[i + 1]"; the name is known.
ExpressionReader::Place ExpressionReader::place(int depth) {
  const JobToken name = line_.take();
  Place place;
  place.variable = draft_.variable_called(without_index(name.text));
  const int size = draft_.array_at(place.variable);
  const int index = index_in(name.text);
  const std::string known(without_index(name.text));
  if (size == 0 && (index >= 0 || line_.peek().text == "[")) {
    line_.error(name, in_quotes(known) + " is no array; declare it, VAR " + known + "[10]");
  } else if (size > 0 && index >= size) {
    line_.error(name,
                "the last element of " + in_quotes(known) + " is " + known + "[" + std::to_string(size - 1) + "]");
  } else if (index >= 0) {
    place.variable += index;
  } else if (size > 0 && !line_.accept("[")) {
    line_.error(name, "which element of " + in_quotes(known) + "? The first one is " + known + "[0]");
  } else if (size > 0) {
    place.size = size;
    const JobToken start = line_.peek();
    place.element = sum("the number of an element", depth + 1);
    place.element.begin_at(start.column);
    if (!line_.failed() && !line_.accept("]")) {
      line_.error(line_.peek(), "expected ']', found " + JobLine::shown(line_.peek()));
    }
    if (const auto element = constant_of(place.element); !line_.failed() && element && !is_index(*element, size)) {
      line_.error(start, "an array has no such element; the first one is [0], the last one of " + in_quotes(known) +
                             " is [" + std::to_string(size - 1) + "]");
    }
  }
  return place;
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
  int negations = 0;
  for (; line_.accept("NOT"); ++negations) {
    what = "a condition";
  }
  Formula formula = comparison(what, depth);
  // Two of them give 1 for every value except 0.
  for (int left = negations > 0 ? 2 - negations % 2 : 0; left > 0; --left) {
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
  const JobToken start = line_.peek();
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
    check_constant(left, start, line_);
  }
  return left;
}

Formula ExpressionReader::product(const char* what, int depth) {
  const JobToken start = line_.peek();
  Formula left = operand(what, depth);
  bool more = true;
  while (more && !line_.failed()) {
    more = false;
    for (const Sign& sign : kProducts) {
      if (line_.accept(sign.text)) {
        const JobToken second = line_.peek();
        const Formula right = operand("a number", depth);
        if (sign.op != FormulaOp::Multiply && constant_of(right) == 0.0) {
          line_.error(second, "this divides by 0");
        }
        left = Formula::joined(std::move(left), right, sign.op);
        check_constant(left, start, line_);
        more = true;
        break;
      }
    }
  }
  return left;
}

}  // namespace indurop::robot
