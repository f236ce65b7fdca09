// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/operation_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "control/plc/check/bare_number.h"
#include "control/plc/check/expression_checker.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;

bool is_elementary_bit(const Type& type) noexcept {
  return type.kind == Type::Kind::Elementary && is_bit(type.elementary);
}

// Returns true for a bit string with more than one bit.
bool is_bits(const Type* type) noexcept {
  return type != nullptr && is_elementary_bit(*type) && !type->is(Elementary::Bool);
}

// Returns true for NOT 16#2, which inverts as many bits as the other side has.
bool is_inverted(const Expression& expression, const Program& program) {
  return expression.kind == Expression::Kind::Unary && expression.op == Operator::Not &&
         is_bare(expression.operands[0], program);
}

bool is_number(const Type& type) noexcept {
  return type.kind == Type::Kind::Elementary && (is_num(type.elementary) || is_elementary_bit(type));
}

// Returns false for an infinite REAL, which is left to the run time; whole numbers wrap.
bool holds(const Type& type, const Constant& value) noexcept {
  return !std::holds_alternative<double>(value) || fits(value, type);
}

// Returns true for 1 / 2 where 0.5 is intended.
bool loses_fraction(const Expression& expression, const Constant& a, const Constant& b, const Type* wanted) noexcept {
  const auto* x = std::get_if<Integer>(&a);
  const auto* y = std::get_if<Integer>(&b);
  return expression.op == Operator::Divide && x != nullptr && y != nullptr && *y != 0 && *x % *y != 0 &&
         wanted != nullptr && wanted->kind == Type::Kind::Elementary && is_real(wanted->elementary);
}

}  // namespace

// In CODESYS the values of an enumeration are numbers, except when two of one enumeration are compared.
void OperationChecker::count_enumerations(Expression& expression) {
  Expression& a = expression.operands[0];
  Expression& b = expression.operands[1];
  const bool equality = expression.op == Operator::Equal || expression.op == Operator::NotEqual;
  if (!context_.codesys() || (equality && same_type(*a.type, *b.type))) {
    return;
  }
  for (Expression* one : {&a, &b}) {
    if (one->type->kind == Type::Kind::Enum) {
      expressions_.casts().cast(*one, *context_.elementary(one->type->elementary));
    }
  }
}

// Returns true for a name that is not a variable, but may be a value of an enumeration.
bool OperationChecker::is_no_variable(const Expression& expression) const {
  const std::string capitals = upper(expression.name);
  return expression.kind == Expression::Kind::Name && expression.value_enum.empty() &&
         (context_.pou == nullptr || context_.pou->find(capitals) == nullptr) &&
         !context_.program.global_names.contains(capitals) && !context_.program.type_names.contains(capitals) &&
         (context_.pou == nullptr || !same_name(context_.pou->name, expression.name));
}

const Type* OperationChecker::unary(Expression& expression, const Type* wanted) {
  Expression& operand = expression.operands[0];
  Resolved& out = resolved(expression);
  const bool negated_literal =
      expression.op == Operator::Negate && operand.kind == Expression::Kind::Literal && operand.value_type;
  if (negated_literal && std::holds_alternative<std::uint64_t>(operand.value)) {
    const Type* type = context_.elementary(*operand.value_type);
    out.constant = -Integer{std::get<std::uint64_t>(operand.value)};
    if (!fits(*out.constant, *type)) {
      context_.error(expression.at,
                     fmt::format("{} does not fit {}, use a larger type", to_string(*out.constant), to_string(*type)));
      return nullptr;
    }
    return type;
  }
  const Type* type = expressions_.value(operand, wanted);
  if (type == nullptr) {
    return nullptr;
  }
  if (expression.op == Operator::Not && operand.resolved->untyped && is_bits(wanted) && adapt(operand, *wanted)) {
    type = wanted;
  }
  const bool number =
      type->kind == Type::Kind::Elementary && (is_signed_int(type->elementary) || is_real(type->elementary) ||
                                               type->is(Elementary::Time) || operand.resolved->untyped);
  if (expression.op == Operator::Not
          ? !is_elementary_bit(*type) && !(context_.codesys() && expressions_.is_whole(*type)) &&
                !adapt(operand, *context_.elementary(Elementary::Bool))
          : !number) {
    context_.error(expression.at, expression.op == Operator::Not
                                      ? fmt::format("NOT needs a BOOL or a bit string, not {}", with_article(*type))
                                      : fmt::format("{} has no sign", with_article(*type)));
    return nullptr;
  }
  out.untyped = operand.resolved->untyped;
  if (const Constant* known = constant_of(operand)) {
    if (auto applied = apply(expression.op, *known)) {
      out.constant = out.untyped ? std::move(applied).value() : stored(*applied, *operand.type);
    }
  }
  return out.untyped ? context_.elementary(default_type(*out.constant)) : context_.elementary(operand.type->elementary);
}

// Checks the values of both sides: first one that has a type, which numbers without one on the other side take if the
// context requires none. Without any type, none is too small: MAX(300, 1) * 300 > 30000. Returns false after an error.
bool OperationChecker::sides(Expression& expression, const Type* wanted) {
  Expression& a = expression.operands[0];
  Expression& b = expression.operands[1];
  const bool a_bare = is_bare(a, context_.program);
  const bool b_bare = is_bare(b, context_.program);
  const bool a_value = is_no_variable(a);
  if (expression.op >= Operator::Less && expression.op <= Operator::NotEqual && a_value != is_no_variable(b)) {
    const Type* type = expressions_.value(a_value ? b : a);  // determines the enumeration of the value
    return expressions_.value(a_value ? a : b, type) != nullptr && type != nullptr;
  }
  const bool a_inverted = is_inverted(a, context_.program);
  if (expression.op >= Operator::And && a_inverted != is_inverted(b, context_.program)) {  // w AND NOT 16#2
    const Type* known = expressions_.value(a_inverted ? b : a, wanted);
    return expressions_.value(a_inverted ? a : b, is_bits(known) ? known : wanted) != nullptr && known != nullptr;
  }
  if (a_bare == b_bare) {
    const Type* hint = wanted;
    if (a_bare && wanted == nullptr) {
      hint = context_.elementary(widest_of(expression, context_.program));
    }
    if (a_bare && expression.op == Operator::Modulo && hint->kind == Type::Kind::Elementary &&
        is_real(hint->elementary)) {  // only whole numbers have it: the widest that become this REAL
      hint = context_.elementary(hint->is(Elementary::Real) ? Elementary::Int : Elementary::Dint);
    }
    const bool fine = expressions_.value(a, hint) != nullptr;
    return expressions_.value(b, hint) != nullptr && fine;
  }
  const Type* known = expressions_.value(a_bare ? b : a, wanted);
  const Type* hint = wanted;
  if (hint == nullptr && known != nullptr && is_number(*known)) {
    hint = context_.elementary(known->elementary);
  }
  return expressions_.value(a_bare ? a : b, hint) != nullptr && known != nullptr;
}

const Type* OperationChecker::binary(Expression& expression, const Type* wanted) {
  const bool compares = expression.op >= Operator::Less && expression.op <= Operator::NotEqual;
  const bool combines = expression.op >= Operator::And;
  if (!sides(expression, compares ? nullptr : wanted)) {
    return nullptr;
  }
  count_enumerations(expression);
  const auto leads = [](const Expression& one) {
    return one.type->kind == Type::Kind::Pointer || one.type->kind == Type::Kind::Interface;
  };
  if (leads(expression.operands[0]) || leads(expression.operands[1])) {
    return compares ? expressions_.pointers().pointer_comparison(expression)
                    : expressions_.pointers().pointer_operation(expression);
  }
  if (!expression.operands[0].resolved->untyped || !expression.operands[1].resolved->untyped) {
    return compares ? comparison(expression) : combines ? logic(expression) : arithmetic(expression, wanted);
  }
  const Constant& a = *constant_of(expression.operands[0]);
  const Constant& b = *constant_of(expression.operands[1]);
  auto applied = apply(expression.op, a, b);
  if (!applied) {
    context_.error(expression.at, applied.error().text);
    return nullptr;
  }
  Resolved& out = resolved(expression);
  out.constant = std::move(applied).value();
  if (loses_fraction(expression, a, b, wanted)) {
    context_.warning(expression.at, fmt::format("{0} / {1} is {2}, a division of whole numbers; write {0}.0 / {1}.0",
                                                to_string(a), to_string(b), to_string(*out.constant)));
  }
  out.untyped = !compares;
  return context_.elementary(default_type(*out.constant));
}

// Converts both to one type; returns false if there is none.
bool OperationChecker::meet(Expression& a, Expression& b) {
  static_cast<void>(adapt_character(a, *b.type) || adapt_character(b, *a.type));
  if (a.resolved->untyped && !adapt(a, *context_.elementary(b.type->elementary)) && !b.type->is_text()) {
    adapt(a, *a.type);
  }
  if (b.resolved->untyped && !adapt(b, *context_.elementary(a.type->elementary)) && !a.type->is_text()) {
    adapt(b, *b.type);
  }
  return context_.common_type(*a.type, *b.type) != nullptr;
}

const Type* OperationChecker::comparison(Expression& expression) {
  Expression& a = expression.operands[0];
  Expression& b = expression.operands[1];
  const bool scalar = a.type->kind <= Type::Kind::Enum && b.type->kind <= Type::Kind::Enum;
  const bool is_enum = a.type->kind == Type::Kind::Enum;
  const bool orders = expression.op < Operator::Equal;
  const std::string unit = a.resolved->untyped   ? unit_hint(*b.type)
                           : b.resolved->untyped ? unit_hint(*a.type)
                                                 : std::string();
  if (!scalar || !meet(a, b) || (is_enum && orders)) {
    context_.error(expression.at,
                   fmt::format("{} and {} cannot be compared{}", with_article(*a.type), with_article(*b.type),
                               !scalar || is_enum ? ""
                               : unit.empty()     ? ", convert one of them"
                                                  : unit));
    return nullptr;
  }
  const Type* common = context_.common_type(*a.type, *b.type);
  resolved(expression).operand = common->range ? context_.elementary(common->elementary) : common;
  if (!is_enum) {
    fold(expression, *resolved(expression).operand);
  }
  if (!orders) {
    warn_about_exactness(expression.at, *resolved(expression).operand, a, b);
  }
  return context_.elementary(Elementary::Bool);
}

// Warns of exact comparisons: sums of REALs are rounded, but a value that is compared with 0 or 2.5 may never have been
// computed.
void OperationChecker::warn_about_exactness(const Place& at, const Type& type, const Expression& a,
                                            const Expression& b) {
  if (type.kind != Type::Kind::Elementary || !is_real(type.elementary)) {
    return;
  }
  const auto exact = [](const Expression& one) {
    const Constant* known = constant_of(one);
    const auto* number = known != nullptr ? std::get_if<double>(known) : nullptr;
    return known != nullptr && (number == nullptr || std::fmod(*number * 8, 1.0) == 0.0);
  };
  if (!exact(a) && !exact(b)) {
    context_.warning(at, fmt::format("two {} are seldom exactly equal, compare ABS(a - b) with a tolerance",
                                     name_of(type.elementary)));
  }
}

const Type* OperationChecker::logic(Expression& expression) {
  Expression& a = expression.operands[0];
  Expression& b = expression.operands[1];
  const auto has_bits = [this](const Type& type) {
    return is_elementary_bit(type) ||
           (context_.codesys() && type.kind == Type::Kind::Elementary && is_int(type.elementary));
  };
  const bool fits = meet(a, b) && has_bits(*a.type) && has_bits(*b.type);
  if (expression.guards && !(fits && b.type->is(Elementary::Bool))) {
    context_.error(b.at, fmt::format("the condition of a transition is a BOOL, not {}, compare it with something",
                                     with_article(*b.type)));
    return nullptr;
  }
  if (!fits) {
    context_.error(expression.at, fmt::format("AND, OR and XOR combine two BOOL or two bit strings, not {} and {}",
                                              with_article(*a.type), with_article(*b.type)));
    return nullptr;
  }
  const Type* type = context_.common_type(*a.type, *b.type);
  resolved(expression).operand = type;
  fold(expression, *type);
  return type;
}

const Type* OperationChecker::arithmetic(Expression& expression, const Type* wanted) {
  const Type* type = expressions_.calls().operation(expression, wanted);
  if (type == nullptr) {
    return nullptr;
  }
  const Constant* divisor = constant_of(expression.operands[1]);
  const bool divides = expression.op == Operator::Divide || expression.op == Operator::Modulo;
  if (divides && divisor != nullptr && (*divisor == Constant(Integer{0}) || *divisor == Constant(0.0))) {
    context_.error(expression.operands[1].at, "division by zero, correct the divisor");
    return nullptr;
  }
  if (is_num(type->elementary)) {
    fold(expression, *type);
  }
  return type;
}

void OperationChecker::fold(Expression& expression, const Type& operand) {
  const Constant* a = constant_of(expression.operands[0]);
  const Constant* b = constant_of(expression.operands[1]);
  if (a == nullptr || b == nullptr || operand.is(Elementary::Wstring)) {
    return;  // the order of UTF-16 differs from that of UTF-8
  }
  const auto known =
      apply(expression.op, operand.is_text() ? *a : stored(*a, operand), operand.is_text() ? *b : stored(*b, operand));
  const bool compares = expression.op >= Operator::Less && expression.op <= Operator::NotEqual;
  if (known && (compares || holds(operand, *known))) {
    resolved(expression).constant = compares ? *known : stored(*known, operand);
  }
}

}  // namespace indurop::plc
