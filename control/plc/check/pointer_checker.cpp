// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/pointer_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/lifetime.h"
#include "control/plc/model/make.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;
using Meaning = Resolved::Meaning;

bool is_zero(const Expression& expression) noexcept {
  const Constant* known = constant_of(expression);
  return known != nullptr && expression.resolved->untyped && *known == Constant(Integer{0});
}

// Returns whether it is NULL, before the expression was checked.
bool is_null(const Expression& expression) noexcept {
  const auto* number = std::get_if<std::uint64_t>(&expression.value);
  return expression.kind == Expression::Kind::Literal
             ? number != nullptr && *number == 0
             : expression.kind == Expression::Kind::Name && same_name(expression.name, "NULL");
}

}  // namespace

const Type* PointerChecker::deref(Expression& expression) {
  const Type* base =
      expressions_.with({true, false}, [&] { return expressions_.typed(expression.operands[0], nullptr); });
  if (base == nullptr) {
    return nullptr;
  }
  const Meaning meaning = expression.operands[0].resolved->meaning;
  if (meaning == Meaning::This || meaning == Meaning::Super) {
    return base;
  }
  if (base->kind != Type::Kind::Pointer) {
    context_.error(expression.at, fmt::format("{} is no pointer, remove the ^", with_article(*base)));
    return nullptr;
  }
  return base->element;
}

// Replaces r of a REFERENCE TO by r^.
const Type* PointerChecker::follow(Expression& expression, const Type& reference) {
  expression.type = &reference;
  Expression inner = std::move(expression);
  expression = Expression{};
  expression.kind = Expression::Kind::Deref;
  expression.at = inner.at;
  expression.operands.push_back(std::move(inner));
  static_cast<void>(resolved(expression));
  expression.type = reference.element;
  return reference.element;
}

const Type* PointerChecker::reference_itself(Expression& expression) {
  const ExpressionChecker::Mode mode{expressions_.mode().reading, false};
  return expressions_.with(mode, [&] { return expressions_.typed(expression, nullptr); });
}

// Reports a pointer to another range: values written through it would not be checked.
void PointerChecker::complain_of_range(const Place& at, const Type& type, const Type& to) {
  context_.error(at, fmt::format("{} and what {} leads to have other limits, so a value could be written that is none "
                                 "of them; use one type for both",
                                 with_article(type), with_article(to)));
}

bool PointerChecker::bind(Expression& expression, const Type& to) {
  const bool named = expression.kind == Expression::Kind::Name && context_.pou->find("NULL") != nullptr;  // a variable
  if (is_null(expression) && !named) {
    return expressions_.value(expression, nullptr) != nullptr;
  }
  const Type* type = expressions_.writes().reference(expression);
  if (type == nullptr || is_open(expression)) {
    return false;
  }
  if (to.element == nullptr || !stands_for(*type, *to.element)) {
    context_.error(expression.at, fmt::format("{} is not what a {} refers to, use a variable of that type",
                                              with_article(*type), to_string(to)));
    return false;
  }
  if (!same_range(*type, *to.element)) {
    complain_of_range(expression.at, *type, to);
    return false;
  }
  context_.pou->points_to_own = context_.pou->points_to_own || ends_with_call(expression);
  expressions_.writes().note_address(expression);
  const Place at = expression.at;
  std::vector<ast::Argument> arguments;
  arguments.push_back(make::argument("", std::move(expression)));
  expression = make::call(at, make::name(at, "REF"), std::move(arguments));
  resolved(expression).intrinsic = Resolved::Intrinsic::Address;
  expression.type = &to;
  return true;
}

bool PointerChecker::assigned_pointer(Expression& expression, const Type& to) {
  if (expression.kind == Expression::Kind::Name && same_name(expression.name, "THIS")) {  // its address
    const Place at = expression.at;
    std::vector<ast::Argument> arguments;
    arguments.push_back(make::argument("", std::move(expression)));
    expression = make::call(at, make::name(at, "ADR"), std::move(arguments));
  }
  const Type* type = expression.kind == Expression::Kind::Call ? expressions_.top_call(expression, &to)
                                                               : expressions_.value(expression, &to);
  if (type == nullptr) {
    return false;
  }
  if (is_zero(expression) || context_.assignable(*expression.type, to)) {
    return true;
  }
  const Type* led_to = expression.type->kind == Type::Kind::Pointer ? expression.type->element : nullptr;
  if (led_to != nullptr && to.element != nullptr && same_type(*led_to, *to.element)) {
    complain_of_range(expression.at, *led_to, to);
    return false;
  }
  context_.error(expression.at, fmt::format("{} is not {}, use ADR(), REF() or NULL", with_article(*expression.type),
                                            with_article(to)));
  return false;
}

// Checks an instance that implements the interface, or another variable of the interface.
bool PointerChecker::assigned_interface(Expression& expression, const Type& to) {
  const Type* type = expression.kind == Expression::Kind::Call ? expressions_.top_call(expression, &to)
                                                               : expressions_.typed(expression, nullptr);
  if (type == nullptr) {
    return false;
  }
  if (is_zero(expression)) {
    return true;
  }
  if (!stands_for(*type, to)) {
    context_.error(expression.at, type->kind == Type::Kind::Block
                                      ? fmt::format("{} does not implement {}, write IMPLEMENTS {} in its declaration",
                                                    to_string(*type), to.name, to.name)
                                      : fmt::format("{} is not {}, use an instance that implements it, or NULL",
                                                    with_article(*type), with_article(to)));
    return false;
  }
  if (type->kind == Type::Kind::Block) {
    expressions_.writes().note_call(expression);
  }
  return true;
}

// Checks p[3]: the value at this offset from p^, counted in values.
const Type* PointerChecker::pointer_index(Expression& expression, const Type& pointer) {
  Expression& index = expression.operands[1];
  const ExpressionChecker::Mode mode{true, expressions_.mode().following};
  const Type* type = expressions_.with(mode, [&] { return expressions_.value(index); });
  if (type != nullptr && !expressions_.is_whole(*type)) {
    context_.error(index.at, fmt::format("an index is a whole number, not {}", with_article(*type)));
    return nullptr;
  }
  return type != nullptr ? pointer.element : nullptr;
}

// Checks pointer arithmetic: p + 3 is three bytes further.
const Type* PointerChecker::pointer_operation(Expression& expression) {
  Expression& a = expression.operands[0];
  Expression& b = expression.operands[1];
  if (expression.op == Operator::Add && b.type->kind == Type::Kind::Pointer) {
    std::swap(a, b);
  }
  const bool moves = expression.op == Operator::Add || expression.op == Operator::Subtract;
  const bool number = b.type->kind == Type::Kind::Elementary &&
                      (is_int(b.type->elementary) || (is_bit(b.type->elementary) && !b.type->is(Elementary::Bool)));
  if (!moves || !number) {
    context_.error(expression.at, fmt::format("{} and {} cannot be combined; a number of bytes is added to a pointer",
                                              with_article(*a.type), with_article(*b.type)));
    return nullptr;
  }
  adapt(b, *b.type);
  resolved(expression).operand = a.type;
  return a.type;
}

const Type* PointerChecker::pointer_comparison(Expression& expression) {
  const Expression& a = expression.operands[0];
  const Expression& b = expression.operands[1];
  const Type::Kind kind = is_zero(a) ? b.type->kind : a.type->kind;
  const auto fits = [&](const Expression& one) { return one.type->kind == kind || is_zero(one); };
  if (!fits(a) || !fits(b)) {
    context_.error(expression.at, fmt::format("{} and {} cannot be compared, use ADR(), REF() or NULL",
                                              with_article(*a.type), with_article(*b.type)));
    return nullptr;
  }
  resolved(expression).operand = a.type->kind == kind ? a.type : b.type;
  return context_.elementary(Elementary::Bool);
}

// Reports accesses into an ARRAY[*]: it exists during the call only, so no pointer or reference may lead into it.
bool PointerChecker::is_open(const Expression& expression) {
  for (const Expression* at = &expression; !at->operands.empty(); at = &at->operands[0]) {
    if (at->operands[0].type != nullptr && at->operands[0].type->open) {
      context_.error(expression.at,
                     "elements of an ARRAY[*] have no address, because it is there during the call only");
      return true;
    }
  }
  return false;
}

}  // namespace indurop::plc
