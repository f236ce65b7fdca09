// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/loss.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/check/expression_checker.h"
#include "core/base/utf8.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;

// Returns the first division or product whose result the rest of the expression only adds to, multiplies, or negates.
const Expression* find(const Expression& expression, Operator op) {
  if (constant_of(expression) != nullptr) {
    return nullptr;
  }
  const bool binary = expression.kind == Expression::Kind::Binary && expression.op >= Operator::Multiply &&
                      expression.op <= Operator::Subtract;
  if (binary && expression.op == op) {
    return &expression;
  }
  if (!binary && (expression.kind != Expression::Kind::Unary || expression.op == Operator::Not)) {
    return nullptr;
  }
  for (const Expression& one : expression.operands) {
    if (const Expression* found = find(one, op)) {
      return found;
    }
  }
  return nullptr;
}

void warn_of_narrow(Context& context, const Expression& expression, const Type& type, const Type& to) {
  const bool numbers = type.kind == Type::Kind::Elementary && to.kind == Type::Kind::Elementary;
  if (!numbers || !is_int(type.elementary) || type.elementary == to.elementary) {
    return;
  }
  const auto name = name_of(type.elementary);
  if (is_real(to.elementary)) {
    if (const Expression* division = find(expression, Operator::Divide)) {
      context.warning(division->at, fmt::format("this is a division of whole numbers, its remainder is lost; convert "
                                                "before: {}_TO_{}(...) / ...",
                                                name, name_of(to.elementary)));
      return;
    }
  } else if (!is_int(to.elementary) || bits_of(to.elementary) <= bits_of(type.elementary)) {
    return;
  }
  if (const Expression* product = find(expression, Operator::Multiply);
      product != nullptr && bits_of(type.elementary) < 64) {
    context.warning(product->at,
                    fmt::format("this is calculated as {0}, so it wraps where the result does not fit {0}; "
                                "convert before: {0}_TO_{1}(...) * ...",
                                name, name_of(to.elementary)));
  }
}

}  // namespace

void warn_of_loss(Context& context, const Expression& expression, const Type& type, const Type& to) {
  const Constant* known = constant_of(expression);
  const auto* text = known != nullptr ? std::get_if<std::string>(known) : nullptr;
  if (text != nullptr && to.is(Elementary::String) && text->size() > to.length) {
    const auto letters = static_cast<std::size_t>(
        std::count_if(text->begin(), text->end(), [](char c) { return !base::continues_utf8(c); }));
    context.warning(
        expression.at,
        letters == text->size()
            ? fmt::format("the text has {} characters and is cut to {}", letters, to.length)
            : fmt::format("the text has {} letters, which are {} characters of a STRING (UTF-8), and is cut "
                          "to {}; use STRING[{}], or WSTRING",
                          letters, text->size(), to.length, text->size()));
  }
  warn_of_narrow(context, expression, type, to);
}

}  // namespace indurop::plc
