// SPDX-License-Identifier: Apache-2.0
#include "tools/client/scope/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace indurop::tools {
namespace {

constexpr std::size_t kMostText = 1000;  // characters of a formula; limits the depth of the parser
constexpr int kMostDepth = 50;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

// Only the first error is kept, in problem_.
class FormulaParser {
 public:
  FormulaParser(std::string_view text, const FindOperand& find) : text_(text), find_(find) {}

  Result<Formula, base::Problem> whole() {
    if (text_.size() > kMostText) {
      return base::Problem{"the expression is too long"};
    }
    const Term term = either(nullptr);
    blanks();
    if (!problem_ && at_ < text_.size()) {
      wrong(at_ == 0 ? "an expression is missing" : "an operator is missing");
    }
    if (problem_) {
      return *problem_;
    }
    out_.unit_ = term.unit;
    return std::move(out_);
  }

 private:
  using Op = Formula::Op;
  using Names = const std::vector<schema::Enumerator>*;
  struct Term {
    std::string unit;
    bool number = false;  // a plain number takes the unit of the other operand
    Names names = nullptr;
  };

  void wrong(const std::string& what) {
    if (!problem_) {
      problem_ = base::Problem{fmt::format("'{}', place {}: {}", text_, at_ + 1, what)};
    }
  }
  void blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) {
      ++at_;
    }
  }
  bool take(std::string_view sign) {
    blanks();
    if (!text_.substr(at_).starts_with(sign)) {
      return false;
    }
    const std::size_t end = at_ + sign.size();
    if (is_letter(sign.front()) && end < text_.size() && (is_letter(text_[end]) || is_digit(text_[end]))) {
      return false;
    }
    at_ = end;
    return true;
  }
  void put(Op op) { out_.steps_.push_back({op, 0, 0}); }

  Term either(Names names) {
    Term left = both(names);
    while (!problem_ && (take("||") || take("or"))) {
      both(nullptr);
      put(Op::Or);
      left = {};
    }
    return left;
  }

  Term both(Names names) {
    Term left = comparison(names);
    while (!problem_ && (take("&&") || take("and"))) {
      comparison(nullptr);
      put(Op::And);
      left = {};
    }
    return left;
  }

  Term comparison(Names names) {
    Term left = sum(names);
    constexpr std::array<std::pair<std::string_view, Op>, 6> kSigns{{{"<=", Op::LessEqual},
                                                                     {">=", Op::MoreEqual},
                                                                     {"==", Op::Equal},
                                                                     {"!=", Op::Unequal},
                                                                     {"<", Op::Less},
                                                                     {">", Op::More}}};
    for (const auto& [sign, op] : kSigns) {
      if (!problem_ && take(sign)) {
        const Term right = sum(left.names);
        (void)common_unit(left, right);
        put(op);
        return {};
      }
    }
    return left;
  }

  std::string common_unit(const Term& left, const Term& right) {
    if (!left.number && !right.number && left.unit != right.unit && !left.unit.empty() && !right.unit.empty()) {
      wrong(fmt::format("{} and {} do not go together", left.unit, right.unit));
    }
    return left.unit.empty() ? right.unit : left.unit;
  }

  Term sum(Names names) {
    Term left = product(names);
    while (!problem_) {
      const bool plus = take("+");
      if (!plus && !take("-")) {
        break;
      }
      const Term right = product(nullptr);
      left = {common_unit(left, right), left.number && right.number, nullptr};
      put(plus ? Op::Plus : Op::Minus);
    }
    return left;
  }

  Term product(Names names) {
    Term left = single(names);
    while (!problem_) {
      const Op divides = take("/") ? Op::Over : Op::Rest;
      const Op op = divides == Op::Rest && take("*") ? Op::Times : divides;
      if (op == Op::Rest && !take("%")) {
        break;
      }
      const Term right = single(nullptr);
      put(op);
      left = {product_unit(left.unit, right.unit, op), left.number && right.number, nullptr};
    }
    return left;
  }

  static std::string product_unit(const std::string& left, const std::string& right, Op op) {
    if (op == Op::Rest || right.empty()) {
      return left;
    }
    if (op == Op::Times) {
      return left.empty() ? right : fmt::format("{}*{}", left, right);
    }
    return left == right ? "" : fmt::format("{}/{}", left.empty() ? "1" : left, right);
  }

  Term single(Names names) {
    if (++depth_ > kMostDepth) {
      wrong("too many brackets and signs");
      return {};
    }
    Term term = innermost(names);
    --depth_;
    return term;
  }

  Term innermost(Names names) {
    blanks();
    if (problem_ || at_ >= text_.size()) {
      wrong("a name or a number is missing");
      return {};
    }
    if (take("-")) {
      Term term = single(nullptr);
      put(Op::Negate);
      return {term.unit, term.number, nullptr};
    }
    if (take("!") || take("not")) {
      single(nullptr);
      put(Op::Not);
      return {};
    }
    if (take("(")) {
      Term term = either(nullptr);
      close();
      return term;
    }
    return is_digit(text_[at_]) || text_[at_] == '.' ? number() : word(names);
  }

  void close() {
    if (!take(")")) {
      wrong("')' is missing");
    }
  }

  Term number() {
    double value = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, code] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (code != std::errc()) {
      wrong("this is no number");
      return {};
    }
    at_ += static_cast<std::size_t>(end - begin);
    constant(value);
    return {"", true, nullptr};
  }
  void constant(double value) { out_.steps_.push_back({Op::Number, value, 0}); }

  // knu::Robot::joints[1].y
  std::string_view name() {
    const std::size_t begin = at_;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '[') {
        const std::size_t end = text_.find(']', at_);
        at_ = end == std::string_view::npos ? text_.size() : end + 1;
      } else if (is_letter(c) || is_digit(c) || c == '.' || c == ':') {
        ++at_;
      } else {
        break;
      }
    }
    return text_.substr(begin, at_ - begin);
  }

  Term word(Names names) {
    const std::size_t begin = at_;
    if (!is_letter(text_[at_]) && text_[at_] != ':') {
      wrong("this is no name, number or operator");
      return {};
    }
    const std::string_view text = name();
    if (text == "true" || text == "false") {
      constant(text == "true" ? 1 : 0);
      return {"", true, nullptr};
    }
    if (take("(")) {
      return call(text, begin);
    }
    if (names != nullptr) {
      const auto found =
          std::find_if(names->begin(), names->end(), [&](const schema::Enumerator& one) { return one.name == text; });
      if (found != names->end()) {
        constant(static_cast<double>(found->value));
        return {"", true, nullptr};
      }
    }
    auto operand = find_(text);
    if (!operand) {
      problem_ = problem_ ? problem_ : operand.error();
      return {};
    }
    out_.steps_.push_back({Op::Input, 0, operand->index});
    return {operand->unit, false, operand->enumerators};
  }

  Term call(std::string_view function, std::size_t begin) {
    const bool one = function == "abs" || function == "sqrt";
    if (!one && function != "min" && function != "max") {
      at_ = begin;
      wrong(fmt::format("there is no function '{}'; there are abs, sqrt, min, max", function));
      return {};
    }
    Term term = either(nullptr);
    if (!one) {
      if (!take(",")) {
        wrong("',' is missing");
      }
      term.unit = common_unit(term, either(nullptr));
    }
    close();
    const Op of_one = function == "abs" ? Op::Abs : Op::Sqrt;
    const Op of_two = function == "min" ? Op::Min : Op::Max;
    put(one ? of_one : of_two);
    return {function == "sqrt" ? "" : term.unit, false, nullptr};
  }

  std::string_view text_;
  const FindOperand& find_;
  std::size_t at_ = 0;
  int depth_ = 0;
  Formula out_;
  std::optional<base::Problem> problem_;
};

Result<Formula, base::Problem> Formula::parse(std::string_view text, const FindOperand& find) {
  return FormulaParser(text, find).whole();
}

Formula Formula::of(const Operand& operand) {
  Formula out;
  out.steps_.push_back({Op::Input, 0, operand.index});
  out.unit_ = operand.unit;
  return out;
}

double Formula::two(Op op, double a, double b) {
  const auto truth = [](bool yes) { return yes ? 1.0 : 0.0; };
  switch (op) {
    case Op::Plus:
      return a + b;
    case Op::Minus:
      return a - b;
    case Op::Times:
      return a * b;
    case Op::Over:
      return a / b;
    case Op::Rest:
      return std::fmod(a, b);
    case Op::Less:
      return truth(a < b);
    case Op::LessEqual:
      return truth(a <= b);
    case Op::More:
      return truth(a > b);
    case Op::MoreEqual:
      return truth(a >= b);
    case Op::Equal:
      return truth(a == b);
    case Op::Unequal:
      return truth(a < b || a > b);
    case Op::And:
      return truth(a != 0 && b != 0);
    case Op::Or:
      return truth(a != 0 || b != 0);
    case Op::Min:
      return std::fmin(a, b);
    case Op::Max:
      return std::fmax(a, b);
    case Op::Number:
    case Op::Input:
    case Op::Negate:
    case Op::Not:
    case Op::Abs:
    case Op::Sqrt:
      break;
  }
  return 0;
}

double Formula::value(std::span<const double> inputs) const {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): each is written before it is read
  std::array<double, kMostText> stack;
  std::size_t top = 0;
  for (const Step& step : steps_) {
    switch (step.op) {
      case Op::Number:
        stack[top++] = step.number;
        break;
      case Op::Input:
        stack[top++] = inputs[step.input];
        break;
      case Op::Negate:
        stack[top - 1] = -stack[top - 1];
        break;
      case Op::Not:
        stack[top - 1] = stack[top - 1] == 0 ? 1 : 0;
        break;
      case Op::Abs:
        stack[top - 1] = std::abs(stack[top - 1]);
        break;
      case Op::Sqrt:
        stack[top - 1] = std::sqrt(stack[top - 1]);
        break;
      case Op::Plus:
      case Op::Minus:
      case Op::Times:
      case Op::Over:
      case Op::Rest:
      case Op::Less:
      case Op::LessEqual:
      case Op::More:
      case Op::MoreEqual:
      case Op::Equal:
      case Op::Unequal:
      case Op::And:
      case Op::Or:
      case Op::Min:
      case Op::Max:
        --top;
        stack[top - 1] = two(step.op, stack[top - 1], stack[top]);
        break;
    }
  }
  return stack[0];
}

}  // namespace indurop::tools
