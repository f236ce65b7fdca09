// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/bare_number.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

using ast::Expression;

// Returns true for MAX(1, 2); the selector of SEL(x, 1, 2) is ignored.
bool is_bare_call(const Expression& call, const Program& program) {
  const Expression& callee = call.operands[0];
  if (callee.kind != Expression::Kind::Name || program.pou_names.contains(upper(callee.name))) {
    return false;
  }
  const auto overloads = find_functions(callee.name);
  const auto of_numbers = std::find_if(overloads.begin(), overloads.end(), [](const LibraryFunction* one) {
    return std::holds_alternative<Generic>(one->result);  // MUL has overloads for TIME, too
  });
  if (of_numbers == overloads.end()) {
    return false;
  }
  const LibraryFunction& function = **of_numbers;
  std::size_t next = 0;
  return std::all_of(call.arguments.begin(), call.arguments.end(), [&](const ast::Argument& argument) {
    const auto position = argument.name.empty() ? std::optional(next) : function.position(argument.name);
    ++next;
    const bool known = position && (*position < function.inputs.size() || function.extensible) && argument.value;
    return known && (function.input(*position).type != function.result || is_bare(*argument.value, program));
  });
}

}  // namespace

bool is_bare(const Expression& expression, const Program& program) {
  switch (expression.kind) {
    case Expression::Kind::Literal:
      return !expression.value_type && !std::holds_alternative<bool>(expression.value) &&
             !std::holds_alternative<std::string>(expression.value);
    case Expression::Kind::Unary:
      return expression.op != ast::Operator::Not && is_bare(expression.operands[0], program);
    case Expression::Kind::Binary:
      return expression.op >= ast::Operator::Power && expression.op <= ast::Operator::Subtract &&
             is_bare(expression.operands[0], program) && is_bare(expression.operands[1], program);
    case Expression::Kind::Call:
      return is_bare_call(expression, program);
    case Expression::Kind::Name:
    case Expression::Kind::Direct:
    case Expression::Kind::Member:
    case Expression::Kind::Bit:
    case Expression::Kind::Index:
    case Expression::Kind::Deref:
      break;
  }
  return false;
}

bool computes(const Expression& bare) {
  constexpr std::array<std::string_view, 6> kSelections{"MAX", "MIN", "LIMIT", "SEL", "MUX", "MOVE"};
  const bool selects = bare.kind == Expression::Kind::Call &&
                       std::any_of(kSelections.begin(), kSelections.end(),
                                   [&](std::string_view one) { return same_name(bare.operands[0].name, one); });
  return bare.kind == Expression::Kind::Binary || (bare.kind == Expression::Kind::Call && !selects) ||
         (bare.kind == Expression::Kind::Unary && computes(bare.operands[0])) ||
         std::any_of(bare.arguments.begin(), bare.arguments.end(),
                     [](const ast::Argument& one) { return one.value && computes(*one.value); });
}

Elementary widest_of(const Expression& bare, const Program& program) {
  const auto real = [&](const Expression& one) {
    return is_bare(one, program) && widest_of(one, program) == Elementary::Lreal;
  };
  const bool is_real = std::holds_alternative<double>(bare.value) ||
                       std::any_of(bare.operands.begin(), bare.operands.end(), real) ||
                       std::any_of(bare.arguments.begin(), bare.arguments.end(),
                                   [&](const ast::Argument& one) { return one.value && real(*one.value); });
  return is_real ? Elementary::Lreal : Elementary::Lint;
}

}  // namespace indurop::plc
