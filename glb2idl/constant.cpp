// SPDX-License-Identifier: Apache-2.0
// Evaluates constant expressions.

#include "glb2idl/constant.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

namespace indurop::glb2idl {
namespace {

constexpr Wide kLeast = std::numeric_limits<std::int64_t>::min();
constexpr Wide kMaxInteger = std::numeric_limits<std::uint64_t>::max();
constexpr std::string_view kNumberHelp =
    "a number is written 12, 0x1F, 0b101, 017 (octal), 1.5, 1e-3 or as a time 10ms";

std::optional<unsigned> digit_of(char c) noexcept {
  if (c >= '0' && c <= '9') {
    return static_cast<unsigned>(c - '0');
  }
  const char small = static_cast<char>(c | 0x20);
  return small >= 'a' && small <= 'f' ? std::optional<unsigned>(static_cast<unsigned>(small - 'a' + 10)) : std::nullopt;
}

struct Number {
  std::optional<Value> value;
  std::string why;
};

Number integer_number(std::string_view text) {
  unsigned base = 10;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    base = 16;
    text.remove_prefix(2);
  } else if (text.starts_with("0b") || text.starts_with("0B")) {
    base = 2;
    text.remove_prefix(2);
  } else if (text.size() > 1 && text[0] == '0') {
    base = 8;
  }
  Value value;
  if (text.empty()) {
    return {std::nullopt, std::string(kNumberHelp)};
  }
  for (const char c : text) {
    const auto digit = digit_of(c);
    if (!digit || *digit >= base) {
      return {std::nullopt, std::string(kNumberHelp)};
    }
    value.integer = value.integer * base + *digit;
    if (value.integer > kMaxInteger) {
      return {std::nullopt, fmt::format("the number does not fit 64 bits, the largest is {}", to_text(kMaxInteger))};
    }
  }
  return {value, ""};
}

Number real_number(std::string_view text) {
  Value value;
  value.kind = Value::Kind::Real;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value.real);
  if (error == std::errc::result_out_of_range) {
    return {std::nullopt, "the number does not fit a double, it must be smaller than 1.8e308"};
  }
  if (error != std::errc() || end != text.data() + text.size()) {
    return {std::nullopt, std::string(kNumberHelp)};
  }
  return {value, ""};
}

Number duration_number(std::string_view text, double unit_ns) {
  Number number = text.find('.') == std::string_view::npos ? integer_number(text) : real_number(text);
  if (!number.value) {
    return number;
  }
  const double ns = number.value->as_double() * unit_ns;
  constexpr double kMaxNs = 9.2e18;
  if (ns > kMaxNs) {
    return {std::nullopt, "this time is too long, the limit is 290 years"};
  }
  Value value;
  value.kind = Value::Kind::Duration;
  value.integer = number.value->kind == Value::Kind::Integer ? number.value->integer * static_cast<Wide>(unit_ns)
                                                             : static_cast<Wide>(std::llround(ns));
  return {value, ""};
}

Number parse_number(std::string_view spelling) {
  std::string text(spelling);
  std::erase(text, '\'');
  constexpr std::array<std::pair<std::string_view, double>, 4> kUnits{
      {{"ns", 1.0}, {"us", 1e3}, {"ms", 1e6}, {"s", 1e9}}};
  for (const auto& [unit, ns] : kUnits) {
    if (text.size() > unit.size() && text.ends_with(unit)) {
      return duration_number(std::string_view(text).substr(0, text.size() - unit.size()), ns);
    }
  }
  const bool hex = text.starts_with("0x") || text.starts_with("0X");
  const bool real = !hex && text.find_first_of(".eE") != std::string::npos;
  if (real) {
    if (text.ends_with('f') || text.ends_with('F')) {
      text.pop_back();
    }
    return real_number(text);
  }
  for (int i = 0; i < 3 && !text.empty() && std::string_view("uUlL").find(text.back()) != std::string_view::npos; ++i) {
    text.pop_back();
  }
  return integer_number(text);
}

class Evaluator {
 public:
  Evaluator(const ConstantLookup& lookup, Diagnostics& diagnostics) : lookup_(lookup), diagnostics_(diagnostics) {}

  std::optional<Value> run(const ast::Expression& e) {
    using Kind = ast::Expression::Kind;
    Value value;
    switch (e.kind) {
      case Kind::Number: {
        Number number = parse_number(e.spelling);
        if (!number.value) {
          return fail(e.at, std::move(number.why));
        }
        return number.value;
      }
      case Kind::Text:
        value.kind = Value::Kind::Text;
        value.text = e.spelling;
        return value;
      case Kind::Character:
        value.integer = static_cast<unsigned char>(e.spelling[0]);
        return value;
      case Kind::Bool:
        value.kind = Value::Kind::Bool;
        value.integer = e.spelling == "true" ? 1 : 0;
        return value;
      case Kind::Path:
        return lookup_(e.path);
      case Kind::Unary:
        return unary(e);
      case Kind::Binary:
        return binary(e);
      case Kind::Conditional:
        return conditional(e);
    }
    return std::nullopt;
  }

 private:
  std::optional<Value> fail(Span at, std::string text) {
    diagnostics_.error(at, std::move(text));
    return std::nullopt;
  }
  std::optional<Value> integer(Span at, Wide value) {
    if (value < kLeast || value > kMaxInteger) {
      return fail(at, "the result does not fit 64 bits, use smaller numbers or a double (1.0)");
    }
    Value result;
    result.integer = value;
    return result;
  }
  std::optional<Value> real(Span at, double value) {
    if (!std::isfinite(value)) {
      return fail(at, "the result does not fit a double, use smaller numbers");
    }
    Value result;
    result.kind = Value::Kind::Real;
    result.real = value;
    return result;
  }
  static Value truth(bool value) {
    Value result;
    result.kind = Value::Kind::Bool;
    result.integer = value ? 1 : 0;
    return result;
  }
  // Returns a number, or nullopt with a message.
  std::optional<Value> operand(const ast::Expression& e) {
    auto value = run(e);
    if (value && !value->is_number()) {
      return fail(e.at, value->kind == Value::Kind::Text ? "a text cannot be calculated with, use a number"
                                                         : "a time cannot be calculated with, write the result");
    }
    return value;
  }

  std::optional<Value> conditional(const ast::Expression& e) {
    const auto condition = operand(e.operands[0]);
    if (!condition) {
      return std::nullopt;
    }
    return run(e.operands[condition->as_double() != 0 ? 1 : 2]);
  }

  std::optional<Value> unary(const ast::Expression& e) {
    auto value = operand(e.operands[0]);
    if (!value) {
      return std::nullopt;
    }
    const char symbol = e.spelling[0];
    if (symbol == '!') {
      return truth(value->as_double() == 0);
    }
    if (value->kind == Value::Kind::Real) {
      return symbol == '~' ? fail(e.at, "'~' needs an integer, remove the fraction")
                           : real(e.at, symbol == '-' ? -value->real : value->real);
    }
    return integer(e.at, symbol == '-' ? -value->integer : symbol == '~' ? ~value->integer : value->integer);
  }

  std::optional<Value> binary(const ast::Expression& e) {
    const auto left = operand(e.operands[0]);
    if (!left) {
      return std::nullopt;
    }
    const bool is_true = left->as_double() != 0;
    if ((e.spelling == "&&" && !is_true) || (e.spelling == "||" && is_true)) {
      return truth(is_true);
    }
    const auto right = operand(e.operands[1]);
    if (!right) {
      return std::nullopt;
    }
    if (e.spelling == "&&" || e.spelling == "||") {
      return truth(right->as_double() != 0);
    }
    if (left->kind == Value::Kind::Real || right->kind == Value::Kind::Real) {
      return reals(e, left->as_double(), right->as_double());
    }
    return integers(e, left->integer, right->integer);
  }

  std::optional<Value> reals(const ast::Expression& e, double a, double b) {
    const std::string& op = e.spelling;
    if (op == "+" || op == "-" || op == "*") {
      return real(e.at, op == "+" ? a + b : op == "-" ? a - b : a * b);
    }
    if (op == "/") {
      return b == 0 ? fail(e.operands[1].at, "division by zero, correct the divisor") : real(e.at, a / b);
    }
    if (auto compared = compare(op, a, b)) {
      return compared;
    }
    return fail(e.at, fmt::format("'{}' needs integers, remove the fractions", op));
  }

  std::optional<Value> integers(const ast::Expression& e, Wide a, Wide b) {
    const std::string& op = e.spelling;
    if ((op == "/" || op == "%") && b == 0) {
      return fail(e.operands[1].at, "division by zero, correct the divisor");
    }
    if ((op == "<<" || op == ">>") && (b < 0 || b > 63)) {
      return fail(e.operands[1].at, "a shift is by 0 to 63 bits, correct it");
    }
    if (auto compared = compare(op, a, b)) {
      return compared;
    }
    switch (op[0]) {
      case '+':
        return integer(e.at, a + b);
      case '-':
        return integer(e.at, a - b);
      case '*': {
        Wide product = 0;
        const bool overflow = __builtin_mul_overflow(a, b, &product);
        return integer(e.at, overflow ? kMaxInteger + 1 : product);
      }
      case '/':
        return integer(e.at, a / b);
      case '%':
        return integer(e.at, a % b);
      case '&':
        return integer(e.at, a & b);
      case '|':
        return integer(e.at, a | b);
      case '^':
        return integer(e.at, a ^ b);
      case '<': {
        Wide shifted = 0;
        const bool overflow = __builtin_mul_overflow(a, Wide{1} << b, &shifted);
        return integer(e.at, overflow ? kMaxInteger + 1 : shifted);
      }
      default:
        return integer(e.at, a >> b);
    }
  }

  template <class T>
  static std::optional<Value> compare(std::string_view op, T a, T b) {
    if (op == "==" || op == "!=") {
      return truth((a == b) == (op == "=="));
    }
    if (op == "<" || op == ">=") {
      return truth((a < b) == (op == "<"));
    }
    if (op == ">" || op == "<=") {
      return truth((a > b) == (op == ">"));
    }
    return std::nullopt;
  }

  const ConstantLookup& lookup_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::string to_text(Wide value) {
  if (value < 0) {
    return fmt::format("{}", static_cast<std::int64_t>(value));
  }
  return fmt::format("{}", static_cast<std::uint64_t>(value));
}

std::string to_text(const Value& value) {
  switch (value.kind) {
    case Value::Kind::Bool:
      return value.integer != 0 ? "true" : "false";
    case Value::Kind::Integer:
      return to_text(value.integer);
    case Value::Kind::Real:
      return fmt::format("{}", value.real);
    case Value::Kind::Text:
      return fmt::format("\"{}\"", value.text);
    case Value::Kind::Duration:
      return fmt::format("{}ns", to_text(value.integer));
  }
  return {};
}

std::optional<Value> evaluate(const ast::Expression& expression, const ConstantLookup& lookup,
                              Diagnostics& diagnostics) {
  return Evaluator(lookup, diagnostics).run(expression);
}

}  // namespace indurop::glb2idl
