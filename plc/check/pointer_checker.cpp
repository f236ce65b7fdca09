// SPDX-License-Identifier: Apache-2.0
// POINTER TO, REF_TO and REFERENCE TO: what they lead to, what can be computed with them, ADR and SIZEOF.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "plc/check/call_checker.h"
#include "plc/check/expression_checker.h"
#include "plc/model/make.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;
using Meaning = Resolved::Meaning;

bool is_zero(const Expression& expression) noexcept {
  const Constant* known = constant_of(expression);
  return known != nullptr && expression.resolved->untyped && *known == Constant(Integer{0});
}

const Type* pointer_to(Context& context, const Type& element, ast::PointerKind kind) {
  Type type;
  type.kind = Type::Kind::Pointer;
  type.element = &element;
  type.pointer = kind;
  return context.program.types.add(std::move(type));
}

struct Extent {
  std::uint64_t bytes = 0;
  std::uint64_t alignment = 1;
};

// As the C++ of the program lays it out; none: function blocks.
std::optional<Extent> extent_of(const Type& type) {
  if (type.is_string()) {
    return Extent{type.length + 1, 1};
  }
  if (type.kind <= Type::Kind::Enum) {
    const std::uint64_t bytes = (bits_of(type.elementary) + 7) / 8;
    return Extent{bytes, bytes};
  }
  if (type.kind == Type::Kind::Pointer) {
    return Extent{24, 8};
  }
  if (type.kind == Type::Kind::Array) {
    auto out = extent_of(*type.element);
    for (const Bounds& one : type.dimensions) {
      out = out ? std::optional(Extent{out->bytes * one.count(), out->alignment}) : std::nullopt;
    }
    return out;
  }
  if (type.kind != Type::Kind::Struct || !type.shared_name.empty()) {
    return std::nullopt;
  }
  Extent sum;
  const auto round = [&](std::uint64_t to) { sum.bytes = (sum.bytes + to - 1) / to * to; };
  for (const Field& field : type.fields) {
    const auto one = extent_of(*field.type);
    if (!one) {
      return std::nullopt;
    }
    round(one->alignment);
    sum.bytes += one->bytes;
    sum.alignment = std::max(sum.alignment, one->alignment);
  }
  round(sum.alignment);
  return sum;
}

}  // namespace

const Type* ExpressionChecker::deref(Expression& expression) {
  const bool following = std::exchange(following_, false);
  const bool reading = std::exchange(reading_, true);
  const Type* base = typed(expression.operands[0], nullptr);
  following_ = following;
  reading_ = reading;
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

// r of a REFERENCE TO stands for r^.
const Type* ExpressionChecker::follow(Expression& expression, const Type& reference) {
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

const Type* ExpressionChecker::reference_itself(Expression& expression) {
  const bool following = std::exchange(following_, false);
  const Type* type = typed(expression, nullptr);
  following_ = following;
  return type;
}

bool ExpressionChecker::bind(Expression& expression, const Type& to) {
  if (is_zero(expression)) {
    return true;
  }
  const Type* type = reference(expression);
  if (type == nullptr) {
    return false;
  }
  if (to.element == nullptr || !stands_for(*type, *to.element)) {
    context_.error(expression.at, fmt::format("{} is not what a {} refers to, use a variable of that type",
                                              with_article(*type), to_string(to)));
    return false;
  }
  const Place at = expression.at;
  std::vector<ast::Argument> arguments;
  arguments.push_back(make::argument("", std::move(expression)));
  expression = make::call(at, make::name(at, "REF"), std::move(arguments));
  resolved(expression).intrinsic = Resolved::Intrinsic::Address;
  expression.type = &to;
  return true;
}

bool ExpressionChecker::assigned_pointer(Expression& expression, const Type& to) {
  if (is_zero(expression) || context_.assignable(*expression.type, to)) {
    return true;
  }
  context_.error(expression.at, fmt::format("{} is not {}, use ADR(), REF() or NULL", with_article(*expression.type),
                                            with_article(to)));
  return false;
}

// An instance that has what the interface asks for, or another variable of it.
bool ExpressionChecker::assigned_interface(Expression& expression, const Type& to) {
  const Type* type = expression.kind == Expression::Kind::Call ? top_call(expression, &to) : typed(expression, nullptr);
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
    note_call(expression);
  }
  return true;
}

// p[3]: what lies as many values behind p^.
const Type* ExpressionChecker::pointer_index(Expression& expression, const Type& pointer) {
  const bool reading = std::exchange(reading_, true);
  Expression& index = expression.operands[1];
  const Type* type = value(index);
  reading_ = reading;
  if (type != nullptr && !is_whole(*type)) {
    context_.error(index.at, fmt::format("an index is a whole number, not {}", with_article(*type)));
    return nullptr;
  }
  return type != nullptr ? pointer.element : nullptr;
}

// p + 3 is three bytes further on.
const Type* ExpressionChecker::pointer_operation(Expression& expression) {
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

const Type* ExpressionChecker::pointer_comparison(Expression& expression) {
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

// ADR(x), REF(x), SIZEOF(x), __ISVALIDREF(r). False: it is nothing of these. Null as the type: after an error.
bool CallChecker::address_call(Expression& call, const Type*& type) {
  const std::string name = upper(call.operands[0].name);
  const bool adr = name == "ADR" || name == "REF";
  if (!adr && name != "SIZEOF" && name != "__ISVALIDREF") {
    return false;
  }
  type = nullptr;
  if (call.arguments.size() != 1 || !call.arguments[0].value || call.arguments[0].output) {
    context_.error(call.at, fmt::format("{} takes one variable", name));
    return true;
  }
  Expression& of = *call.arguments[0].value;
  Resolved& out = ExpressionChecker::resolved(call);
  if (adr) {
    const Type* found = expressions_.reference(of);
    out.intrinsic = Resolved::Intrinsic::Address;
    type = found == nullptr
               ? nullptr
               : pointer_to(context_, *found, name == "ADR" ? ast::PointerKind::PointerTo : ast::PointerKind::RefTo);
  } else if (name == "SIZEOF") {
    type = size_of(call, of);
  } else {
    const Type* found = expressions_.reference_itself(of);
    if (found != nullptr && found->kind != Type::Kind::Pointer) {
      context_.error(of.at, fmt::format("{} is no reference", with_article(*found)));
      return true;
    }
    out.intrinsic = Resolved::Intrinsic::IsValid;
    type = found == nullptr ? nullptr : context_.elementary(Elementary::Bool);
  }
  return true;
}

const Type* CallChecker::size_of(Expression& call, Expression& of) {
  const auto elementary = of.kind == Expression::Kind::Name ? elementary_named(of.name) : std::nullopt;
  const Type* found = elementary ? context_.elementary(*elementary) : expressions_.typed(of, nullptr);
  if (found == nullptr && of.resolved && of.resolved->meaning == Meaning::Type) {
    found = of.type;
  }
  if (found == nullptr) {
    return nullptr;
  }
  Resolved& out = ExpressionChecker::resolved(call);
  out.intrinsic = Resolved::Intrinsic::Size;
  out.operand = found;
  if (const auto extent = extent_of(*found)) {
    out.constant = Integer{extent->bytes};
    out.untyped = true;
    return context_.elementary(default_type(*out.constant));
  }
  return context_.elementary(Elementary::Udint);
}

}  // namespace indurop::plc
