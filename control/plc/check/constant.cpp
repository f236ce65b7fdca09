// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/constant.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "control/plc/model/characters.h"

namespace indurop::plc {
namespace {

using ast::Operator;

// Larger numbers are never IEC values.
constexpr Integer kMaxInteger = Integer{1} << 64U;

using Applied = Result<Constant, base::Problem>;

base::Problem of_other_kinds() {
  return {"these numbers cannot be combined so"};
}

Applied division_by_zero() {
  return base::Problem{"division by zero, correct the divisor"};
}

template <class T>
Applied compare(Operator op, const T& a, const T& b) {
  switch (op) {
    case Operator::Less:
      return Constant(a < b);
    case Operator::Greater:
      return Constant(a > b);
    case Operator::LessEqual:
      return Constant(a <= b);
    case Operator::GreaterEqual:
      return Constant(a >= b);
    case Operator::Equal:
      return Constant(a == b);
    case Operator::NotEqual:
      return Constant(a != b);
    default:
      return of_other_kinds();
  }
}

bool is_time(Elementary type) noexcept {
  return type == Elementary::Time || is_date(type);
}

Integer product(Integer a, Integer b) noexcept {
  Integer out = 0;
  return __builtin_mul_overflow(a, b, &out) ? kMaxInteger : out;
}

std::optional<Integer> power(Integer base, Integer exponent) {
  Integer out = 1;
  for (; exponent > 0; --exponent) {
    out = product(out, base);
    if (out > kMaxInteger || out < -kMaxInteger) {
      return std::nullopt;
    }
    if (out == 0 || out == 1) {
      return out;
    }
    if (out == -1) {
      return exponent % 2 == 1 ? out : Integer{1};
    }
  }
  return out;
}

Applied integers(Operator op, Integer a, Integer b) {
  Integer out = 0;
  switch (op) {
    case Operator::Add:
      out = a + b;
      break;
    case Operator::Subtract:
      out = a - b;
      break;
    case Operator::Multiply:
      out = product(a, b);
      break;
    case Operator::Divide:
    case Operator::Modulo:
      if (b == 0) {
        return division_by_zero();
      }
      out = op == Operator::Divide ? a / b : a % b;
      break;
    case Operator::Power:
      if (b < 0) {
        return of_other_kinds();
      }
      out = power(a, b).value_or(kMaxInteger);
      break;
    case Operator::And:
      out = a & b;
      break;
    case Operator::Or:
      out = a | b;
      break;
    case Operator::Xor:
      out = a ^ b;
      break;
    default:
      return compare(op, a, b);
  }
  if (out >= kMaxInteger || out <= -kMaxInteger) {
    return base::Problem{"the result does not fit 64 bits, correct the numbers"};
  }
  return Constant(out);
}

// Returns a constant unless it is infinite or NaN: such results are left to the run time, which knows how to treat
// them.
Applied finite(double value) {
  if (!std::isfinite(value)) {
    return base::Problem{"the result is no number that LREAL holds, correct the numbers"};
  }
  return Constant(value);
}

Applied reals(Operator op, double a, double b) {
  switch (op) {
    case Operator::Add:
      return finite(a + b);
    case Operator::Subtract:
      return finite(a - b);
    case Operator::Multiply:
      return finite(a * b);
    case Operator::Divide:
      return b == 0 ? division_by_zero() : finite(a / b);
    case Operator::Power:
      return finite(std::pow(a, b));
    default:
      return compare(op, a, b);
  }
}

Applied booleans(Operator op, bool a, bool b) {
  switch (op) {
    case Operator::And:
      return Constant(a && b);
    case Operator::Or:
      return Constant(a || b);
    case Operator::Xor:
      return Constant(a != b);
    default:
      return compare(op, a, b);
  }
}

std::optional<double> as_double(const Constant& value) noexcept {
  if (const auto* real = std::get_if<double>(&value)) {
    return *real;
  }
  const auto* integer = std::get_if<Integer>(&value);
  return integer != nullptr ? std::optional(static_cast<double>(*integer)) : std::nullopt;
}

}  // namespace

Result<Constant, base::Problem> apply(Operator op, const Constant& a) {
  const auto* flag = std::get_if<bool>(&a);
  if (flag != nullptr && op == Operator::Not) {
    return Constant(!*flag);
  }
  if (const auto* integer = std::get_if<Integer>(&a); integer != nullptr && op == Operator::Negate) {
    return integers(Operator::Subtract, 0, *integer);
  }
  if (const auto* real = std::get_if<double>(&a); real != nullptr && op == Operator::Negate) {
    return Constant(-*real);
  }
  if (flag == nullptr && op == Operator::Plus) {
    return a;
  }
  return of_other_kinds();
}

Result<Constant, base::Problem> apply(Operator op, const Constant& a, const Constant& b) {
  if (a.index() == b.index()) {
    if (const auto* flag = std::get_if<bool>(&a)) {
      return booleans(op, *flag, std::get<bool>(b));
    }
    if (const auto* integer = std::get_if<Integer>(&a)) {
      return integers(op, *integer, std::get<Integer>(b));
    }
    if (const auto* text = std::get_if<std::string>(&a)) {
      return compare(op, *text, std::get<std::string>(b));
    }
  }
  const auto x = as_double(a);
  const auto y = as_double(b);
  return x && y ? reals(op, *x, *y) : of_other_kinds();
}

bool fits(const Constant& value, const Type& type) noexcept {
  if (type.kind != Type::Kind::Elementary) {
    return false;
  }
  if (std::holds_alternative<bool>(value)) {
    return type.is(Elementary::Bool);
  }
  if (const auto* real = std::get_if<double>(&value)) {
    return type.is(Elementary::Lreal) || (type.is(Elementary::Real) && std::isfinite(static_cast<float>(*real)));
  }
  if (const auto* text = std::get_if<std::string>(&value)) {
    return type.is_text() && characters_of(*text, type.elementary) <= type.length;
  }
  const Integer number = std::get<Integer>(value);
  if (is_real(type.elementary)) {
    return true;
  }
  if (type.is_text() || (type.is(Elementary::Bool) && number != 0 && number != 1)) {
    return false;
  }
  const IntegerLimits limits = limits_of(
      bits_of(type.elementary) == 64 && !is_bit(type.elementary) && !is_int(type.elementary) ? Elementary::Lint
                                                                                             : type.elementary);
  return number >= Integer{limits.low} && number <= Integer{limits.high};
}

bool adapts(const Constant& value, const Type& type) noexcept {
  const bool has_unit =
      type.kind == Type::Kind::Elementary && (is_time(type.elementary) || is_character(type.elementary));
  return fits(value, type) && !has_unit;
}

Elementary default_type(const Constant& constant) noexcept {
  const auto* number = std::get_if<Integer>(&constant);
  if (number == nullptr) {
    return std::holds_alternative<double>(constant) ? Elementary::Lreal : Elementary::Bool;
  }
  for (const Elementary type : {Elementary::Int, Elementary::Dint, Elementary::Lint}) {
    const IntegerLimits limits = limits_of(type);
    if (*number >= Integer{limits.low} && *number <= Integer{limits.high}) {
      return type;
    }
  }
  return Elementary::Ulint;
}

std::string unit_hint(const Type& type) {
  if (type.kind == Type::Kind::Elementary && is_character(type.elementary)) {
    return type.is(Elementary::Char) ? "; write the character, CHAR#'a'" : "; write the character, WCHAR#\"a\"";
  }
  if (type.kind != Type::Kind::Elementary || !is_time(type.elementary)) {
    return {};
  }
  const char* example = "DT#2026-01-31-12:30:00";
  if (type.is(Elementary::Time)) {
    example = "T#500ms";
  } else if (type.is(Elementary::Date)) {
    example = "D#2026-01-31";
  } else if (type.is(Elementary::TimeOfDay)) {
    example = "TOD#12:30:00";
  }
  return fmt::format("; a number has no unit, write {}", example);
}

Constant stored(const Constant& value, const Type& type) {
  const auto* number = std::get_if<Integer>(&value);
  if (number == nullptr) {
    const auto* real = std::get_if<double>(&value);
    return real != nullptr && type.is(Elementary::Real) ? Constant(static_cast<double>(static_cast<float>(*real)))
                                                        : value;
  }
  if (is_real(type.elementary)) {
    return static_cast<double>(*number);
  }
  if (type.is(Elementary::Bool)) {
    return *number != 0;
  }
  const unsigned bits = bits_of(type.elementary);
  const Integer span = Integer{1} << bits;
  Integer wrapped = *number % span;
  wrapped += wrapped < 0 ? span : 0;
  const bool has_sign = !is_bit(type.elementary) && !is_unsigned_int(type.elementary) && !is_character(type.elementary);
  return has_sign && wrapped >= span / 2 ? wrapped - span : wrapped;
}

std::string to_string(const Constant& value) {
  if (const auto* flag = std::get_if<bool>(&value)) {
    return *flag ? "TRUE" : "FALSE";
  }
  if (const auto* real = std::get_if<double>(&value)) {
    return fmt::format("{}", *real);
  }
  if (const auto* text = std::get_if<std::string>(&value)) {
    return "'" + *text + "'";
  }
  const Integer number = std::get<Integer>(value);
  const auto size = static_cast<std::uint64_t>(number < 0 ? -number : number);
  return fmt::format("{}{}", number < 0 ? "-" : "", size);
}

std::optional<std::int64_t> as_int64(const Constant& value) noexcept {
  const auto* number = std::get_if<Integer>(&value);
  if (number == nullptr || *number > Integer{std::numeric_limits<std::int64_t>::max()} ||
      *number < Integer{std::numeric_limits<std::int64_t>::min()}) {
    return std::nullopt;
  }
  return static_cast<std::int64_t>(*number);
}

}  // namespace indurop::plc
