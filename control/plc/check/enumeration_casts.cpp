// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/enumeration_casts.h"

#include <fmt/format.h>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/model/make.h"

namespace indurop::plc {
namespace {

using ast::Expression;

bool is_whole(const Type& type) noexcept {
  return type.kind == Type::Kind::Elementary &&
         (is_int(type.elementary) || (is_bit(type.elementary) && !type.is(Elementary::Bool)));
}

bool is_number(const Type& type) noexcept {
  return is_whole(type) || (type.kind == Type::Kind::Elementary && is_real(type.elementary));
}

}  // namespace

void EnumerationCasts::cast(Expression& expression, const Type& to) {
  const Type* from = expression.type;
  const Place at = expression.at;
  const auto known = expression.resolved->constant;
  std::vector<ast::Argument> arguments;
  arguments.push_back(make::argument("", std::move(expression)));
  expression = make::call(at, make::name(at, to_string(to)), std::move(arguments));
  Resolved& out = resolved(expression);
  out.cast = true;
  out.actuals.push_back({&expression.arguments.front(), from, nullptr, ""});
  out.constant = known;
  expression.type = &to;
}

// Returns whether the rules of CODESYS converted the expression to `to`: from an enumeration to a number or back.
bool EnumerationCasts::convert_enumeration(Expression& expression, const Type& to) {
  if (!context_.codesys() || expression.type == nullptr) {
    return false;
  }
  if (expression.type->kind == Type::Kind::Enum && is_number(to)) {
    cast(expression, *context_.elementary(expression.type->elementary));
    return context_.assignable(*expression.type, to);
  }
  if (to.kind != Type::Kind::Enum || !is_whole(*expression.type)) {
    return false;
  }
  const Type& number = *context_.elementary(to.elementary);
  if (!adapt(expression, number) && !context_.assignable(*expression.type, number)) {
    return false;
  }
  cast(expression, to);
  return true;
}

// Checks COLOR_TO_INT(c), INT_TO_COLOR(i), TO_COLOR(i). Returns false if it is none of these. Otherwise sets `type` to
// that of the result, null after an error; COLOR_TO_INT(c) becomes TO_INT() of a number, for the library.
bool EnumerationCasts::enumeration_call(Expression& call, const Type*& type) {
  const std::string name = upper(call.operands[0].name);
  const std::size_t at = name.starts_with("TO_") ? 0 : name.find("_TO_");
  if (at == std::string::npos || call.arguments.size() != 1 || !call.arguments[0].value) {
    return false;
  }
  const auto enumeration = [this](const std::string& of) -> const Type* {
    if (elementary_named(of)) {
      return nullptr;
    }
    const auto found = context_.program.type_names.find(of);
    const Type* const one =
        found != context_.program.type_names.end() ? found->second : foreign_type_named(context_, of);
    return one != nullptr && one->kind == Type::Kind::Enum ? one : nullptr;
  };
  const std::string from_name = name.substr(0, at);
  const std::string to_name = name.substr(at + (at == 0 ? 3 : 4));
  const Type* from = enumeration(from_name);
  const Type* to = enumeration(to_name);
  const auto number = elementary_named(from_name);
  const Type* wanted = from != nullptr ? from : number ? context_.elementary(*number) : nullptr;
  if ((from == nullptr && to == nullptr) || (to == nullptr && !elementary_named(to_name)) ||
      (wanted == nullptr && at > 0)) {
    return false;
  }
  Expression& value = *call.arguments[0].value;
  type = nullptr;
  if (wanted != nullptr ? !expressions_.assigned(value, *wanted) : expressions_.value(value) == nullptr) {
    return true;
  }
  if (value.type->kind == Type::Kind::Enum) {
    cast(value, *context_.elementary(value.type->elementary));
  }
  if (to == nullptr) {
    call.operands[0].name = "TO_" + to_name;
    return false;
  }
  adapt(value, *context_.elementary(to->elementary));
  if (!is_whole(*value.type)) {
    context_.error(call.at, fmt::format("{} takes a whole number, not {}", name, with_article(*value.type)));
    return true;
  }
  Expression inner = std::move(value);
  call = std::move(inner);
  cast(call, *to);
  type = to;
  return true;
}

}  // namespace indurop::plc
