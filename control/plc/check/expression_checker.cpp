// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/expression_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>

#include "control/plc/check/designator.h"
#include "control/plc/check/loss.h"
#include "control/plc/model/characters.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

Constant constant_of_literal(const ast::LiteralValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) {
    return *flag;
  }
  if (const auto* number = std::get_if<std::uint64_t>(&value)) {
    return Integer{*number};
  }
  if (const auto* real = std::get_if<double>(&value)) {
    return *real;
  }
  if (const auto* ns = std::get_if<std::int64_t>(&value)) {
    return Integer{*ns};
  }
  return std::get<std::string>(value);
}

// Turns x into x <> 0.
Expression& make_truth(Expression& expression) {
  Expression number = std::move(expression);
  number.as_truth = false;
  Expression zero;
  zero.at = number.at;
  zero.value = std::uint64_t{0};
  expression = Expression{};
  expression.kind = Expression::Kind::Binary;
  expression.op = ast::Operator::NotEqual;
  expression.at = zero.at;
  expression.operands.push_back(std::move(number));
  expression.operands.push_back(std::move(zero));
  static_cast<void>(resolved(expression));
  return expression;
}

}  // namespace

ExpressionChecker::ExpressionChecker(Context& context)
    : context_(context),
      names_(*this, context),
      methods_(*this, context),
      pointers_(*this, context),
      operations_(*this, context),
      writes_(*this, context),
      casts_(*this, context),
      initials_(*this, context),
      calls_(*this, context) {}

bool counts_as_truth(const Expression& expression, const Type& type) noexcept {
  const Resolved* root = root_of(expression).resolved.get();
  const bool shared = root != nullptr && root->global != nullptr && root->global->kind == Global::Kind::Foreign;
  return expression.as_truth && shared && type.kind == Type::Kind::Elementary &&
         (is_int(type.elementary) || (is_bit(type.elementary) && !type.is(Elementary::Bool)));
}

bool adapt_character(Expression& expression, const Type& to) {
  if (to.kind != Type::Kind::Elementary || !is_character(to.elementary) ||
      expression.kind != Expression::Kind::Literal || constant_of(expression) == nullptr) {
    return false;
  }
  const auto* text = std::get_if<std::string>(constant_of(expression));
  const Elementary of = to.is(Elementary::Char) ? Elementary::String : Elementary::Wstring;
  const auto code =
      text != nullptr && expression.value_type == of ? code_of_character(*text, to.elementary) : std::nullopt;
  if (code) {
    expression.resolved->constant = Integer{*code};
    expression.type = &to;
  }
  return code.has_value();
}

bool adapt(Expression& expression, const Type& to) {
  if (!expression.resolved || !expression.resolved->untyped || !adapts(*expression.resolved->constant, to)) {
    return false;
  }
  expression.resolved->constant = stored(*expression.resolved->constant, to);
  expression.resolved->untyped = false;
  expression.type = &to;
  return true;
}

const Constant* constant_of(const Expression& expression) noexcept {
  return expression.resolved && expression.resolved->constant ? &*expression.resolved->constant : nullptr;
}

Resolved& resolved(Expression& expression) {
  if (!expression.resolved) {
    expression.resolved = std::make_shared<Resolved>();
  }
  return *expression.resolved;
}

const Type* ExpressionChecker::value_or_instance(Expression& expression, const Type* wanted) {
  const Type* type = typed(expression, wanted);
  const Meaning meaning = expression.resolved->meaning;
  if (type == nullptr && (meaning == Meaning::Type || meaning == Meaning::Namespace)) {
    context_.error(expression.at, fmt::format("'{}' is a {}, but a value is needed", expression.name,
                                              meaning == Meaning::Type ? "type" : "namespace"));
  }
  return type;
}

const Type* ExpressionChecker::value(Expression& expression, const Type* wanted) {
  const Type* type = value_or_instance(expression, wanted);
  if (type == nullptr || type->kind != Type::Kind::Block) {
    return type;
  }
  const auto items = wanted == nullptr ? std::span<const EnumItem>() : std::span(wanted->items);
  const auto hidden = std::find_if(items.begin(), items.end(), [&](const EnumItem& item) {
    return expression.kind == Expression::Kind::Name && upper(item.name) == upper(expression.name);
  });
  if (hidden != items.end()) {
    context_.error(expression.at,
                   fmt::format("'{}' is {} here, which hides a value of {}, write {}#{}", expression.name,
                               with_article(*type), wanted->name, wanted->name, hidden->name));
    return nullptr;
  }
  const bool is_struct = type->pou != nullptr && type->pou->tree->is_struct;
  context_.error(expression.at, fmt::format("{} is not a value{}, name one of its {}", with_article(*type),
                                            is_struct ? " because it contains function blocks" : "",
                                            is_struct ? "fields" : "outputs"));
  return nullptr;
}

const Type* ExpressionChecker::typed(Expression& expression, const Type* wanted) {
  if (resolved(expression).cast || expression.resolved->settled) {
    return expression.type;
  }
  const Type* type = nullptr;
  switch (expression.kind) {
    case Expression::Kind::Literal:
      type = literal(expression, wanted);
      break;
    case Expression::Kind::Name:
      type = names_.name(expression, wanted);
      break;
    case Expression::Kind::Direct:
      type = names_.direct(expression);
      break;
    case Expression::Kind::Member:
      type = names_.member(expression);
      break;
    case Expression::Kind::Bit:
      type = bit(expression);
      break;
    case Expression::Kind::Index:
      type = index(expression);
      break;
    case Expression::Kind::Deref:
      type = pointers_.deref(expression);
      break;
    case Expression::Kind::Call:
      type = calls_.function(expression, wanted, false);
      break;
    case Expression::Kind::Unary:
      type = operations_.unary(expression, wanted);
      break;
    case Expression::Kind::Binary:
      type = operations_.binary(expression, wanted);
      break;
  }
  const bool made = expression.kind == Expression::Kind::Call && expression.resolved->pou == nullptr;  // REF()
  if (type != nullptr && type->is_reference() && mode_.following && !made) {
    return pointers_.follow(expression, *type);
  }
  if (type != nullptr && mode_.reading && counts_as_truth(expression, *type)) {
    return typed(make_truth(expression), nullptr);
  }
  if (expression.resolved->meaning != Meaning::Type) {  // a type stays recorded for the member after it
    expression.type = type;
  }
  return type;
}

bool ExpressionChecker::assigned(Expression& expression, const Type& to) {
  if (to.is_reference()) {
    return pointers_.bind(expression, to);
  }
  if (to.open) {
    context_.error(expression.at, "an ARRAY[*] is not assigned as a whole, assign its elements");
    return false;
  }
  if (to.kind == Type::Kind::Pointer) {
    return pointers_.assigned_pointer(expression, to);
  }
  if (to.kind == Type::Kind::Interface) {
    return pointers_.assigned_interface(expression, to);
  }
  const Type* type = expression.kind == Expression::Kind::Call ? top_call(expression, &to) : value(expression, &to);
  if (type == nullptr) {
    return false;
  }
  const bool fine =
      adapt(expression, to) || context_.assignable(*expression.type, to) || casts_.convert_enumeration(expression, to);
  if (!fine) {
    const Constant* known = constant_of(expression);
    if (known != nullptr && expression.resolved->untyped) {
      context_.error(expression.at, unit_hint(to).empty() ? fmt::format("{} does not fit {}, use another value or type",
                                                                        to_string(*known), to_string(to))
                                                          : fmt::format("{} is not {}{}", to_string(*known),
                                                                        with_article(to), unit_hint(to)));
    } else if (type->kind == Type::Kind::Elementary && to.kind == Type::Kind::Elementary) {
      context_.error(
          expression.at,
          fmt::format("{0} is not converted to {1} automatically, convert it with {2}_TO_{3}()", with_article(*type),
                      with_article(to), name_of(type->elementary), name_of(to.elementary)));
    } else {
      context_.error(expression.at,
                     fmt::format("{} is not {}, use a value of the same type", with_article(*type), with_article(to)));
    }
    return false;
  }
  const Constant* known = constant_of(expression);
  const auto number = known != nullptr ? as_int64(*known) : std::nullopt;
  if (number && to.range && (*number < to.range->low || *number > to.range->high)) {
    context_.error(expression.at, fmt::format("{} is outside of {}, use a value inside", *number, to_string(to)));
    return false;
  }
  warn_of_loss(context_, expression, *type, to);
  return true;
}

const Type* ExpressionChecker::top_call(Expression& expression, const Type* wanted) {
  if (!resolved(expression).cast && !expression.resolved->settled) {
    const Type* type = calls_.function(expression, wanted, true);
    expression.type = type;  // the call may have been replaced by another expression
    if (type != nullptr && type->is_reference() && expression.resolved->pou != nullptr) {
      return pointers_.follow(expression, *type);
    }
  }
  return expression.type;
}

void ExpressionChecker::call_statement(Expression& expression) {
  static_cast<void>(resolved(expression));
  calls_.statement(expression);
}

const Type* ExpressionChecker::literal(Expression& expression, const Type* wanted) {
  Resolved& out = resolved(expression);
  out.constant = constant_of_literal(expression.value);
  if (const auto* text = std::get_if<std::string>(&expression.value)) {
    if (wanted != nullptr && adapt_character(expression, *wanted)) {
      return wanted;
    }
    const Elementary of = expression.value_type.value_or(Elementary::String);
    return context_.program.types.text(of, characters_of(*text, of));
  }
  if (expression.value_type) {
    const Type* type = context_.elementary(*expression.value_type);
    if (!fits(*out.constant, *type)) {
      context_.error(expression.at,
                     fmt::format("{} does not fit {}, use a larger type", to_string(*out.constant), to_string(*type)));
      return nullptr;
    }
    out.constant = stored(*out.constant, *type);
    return type;
  }
  out.untyped = true;
  return context_.elementary(default_type(*out.constant));
}

const Type* ExpressionChecker::bit(Expression& expression) {
  const Type* base = value(expression.operands[0]);
  if (base == nullptr) {
    return nullptr;
  }
  const bool has_bits = base->kind == Type::Kind::Elementary && !base->is(Elementary::Bool) &&
                        (is_bit(base->elementary) || is_int(base->elementary));
  if (expression.width > 1) {
    return part(expression, *base);
  }
  if (!has_bits || expression.bit >= bits_of(base->elementary)) {
    context_.error(expression.at,
                   has_bits ? fmt::format("{} has the bits 0 to {}", with_article(*base), bits_of(base->elementary) - 1)
                            : with_article(*base) + " has no bits");
    return nullptr;
  }
  return context_.elementary(Elementary::Bool);
}

// Checks w.%B1.
const Type* ExpressionChecker::part(Expression& expression, const Type& base) {
  const Elementary type = expression.width == 8    ? Elementary::Byte
                          : expression.width == 16 ? Elementary::Word
                                                   : Elementary::Dword;
  const bool has_parts = base.kind == Type::Kind::Elementary && is_bit(base.elementary) && !base.range &&
                         expression.width < bits_of(base.elementary);
  if (!has_parts || expression.bit >= bits_of(base.elementary)) {
    context_.error(expression.at, fmt::format("{} has no {} {}", with_article(base), name_of(type),
                                              expression.bit / expression.width));
    return nullptr;
  }
  return context_.elementary(type);
}

// Checks s[1], the first character, a CHAR; in CODESYS s[0], a BYTE. Characters of a WSTRING are a WCHAR or a WORD.
const Type* ExpressionChecker::character(Expression& expression, const Type& text) {
  Expression& index = expression.operands[1];
  const Type* type = with({true, mode_.following}, [&] { return value(index); });
  if (type == nullptr || !is_whole(*type)) {
    if (type != nullptr) {
      context_.error(index.at, fmt::format("an index is a whole number, not {}", with_article(*type)));
    }
    return nullptr;
  }
  const Constant* known = constant_of(index);
  const int first = context_.codesys() ? 0 : 1;
  if (known != nullptr && (std::get<Integer>(*known) < first || std::get<Integer>(*known) > Integer{text.length})) {
    context_.error(index.at,
                   fmt::format("index {} is outside of {}..{}, correct it", to_string(*known), first, text.length));
    return nullptr;
  }
  context_.program.types.note_aliases();
  const bool wide = text.is(Elementary::Wstring);
  const Elementary number = wide ? Elementary::Word : Elementary::Byte;
  return context_.elementary(context_.codesys() ? number : wide ? Elementary::Wchar : Elementary::Char);
}

const Type* ExpressionChecker::index(Expression& expression) {
  const Type* base = value(expression.operands[0]);
  if (base != nullptr && base->kind == Type::Kind::Pointer && expression.operands.size() == 2) {
    return pointers_.pointer_index(expression, *base);
  }
  if (base != nullptr && base->is_text() && expression.operands.size() == 2) {
    return character(expression, *base);
  }
  bool fine = base != nullptr;
  if (base != nullptr && base->kind != Type::Kind::Array) {
    context_.error(expression.at, fmt::format("{} has no elements, remove the index", with_article(*base)));
    fine = false;
  } else if (base != nullptr && base->dimensions.size() != expression.operands.size() - 1) {
    context_.error(expression.at, fmt::format("{} needs {} indices, not {}", to_string(*base), base->dimensions.size(),
                                              expression.operands.size() - 1));
    fine = false;
  }
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    Expression& one = expression.operands[i];
    const Type* type = with({true, mode_.following}, [&] { return value(one); });
    if (type == nullptr || !fine) {
      fine = false;
      continue;
    }
    if (!is_whole(*type)) {
      context_.error(one.at, fmt::format("an index is a whole number, not {}", with_article(*type)));
      fine = false;
      continue;
    }
    const Bounds bounds = base->dimensions[i - 1];
    const Constant* known = base->open ? nullptr : constant_of(one);
    if (known != nullptr &&
        (std::get<Integer>(*known) < Integer{bounds.low} || std::get<Integer>(*known) > Integer{bounds.high})) {
      context_.error(
          one.at, fmt::format("index {} is outside of {}..{}, correct it", to_string(*known), bounds.low, bounds.high));
      fine = false;
    }
  }
  return fine ? base->element : nullptr;
}

// Returns true for integers, and in CODESYS also for bit strings.
bool ExpressionChecker::is_whole(const Type& type) const noexcept {
  return type.kind == Type::Kind::Elementary &&
         (is_int(type.elementary) || (context_.codesys() && is_bit(type.elementary) && !type.is(Elementary::Bool)));
}

std::optional<std::int64_t> ExpressionChecker::constant(Expression& expression, std::string_view what) {
  if (value(expression) == nullptr) {
    return std::nullopt;
  }
  const Constant* known = constant_of(expression);
  const auto number = known != nullptr ? as_int64(*known) : std::nullopt;
  if (!number) {
    context_.error(expression.at, fmt::format("{} must be a whole number known now, use a number or a CONSTANT", what));
  }
  return number;
}

}  // namespace indurop::plc
