// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/designator.h"

namespace indurop::plc {

using ast::Expression;
using Meaning = Resolved::Meaning;

bool is_designator(const Expression& expression) noexcept {
  switch (expression.kind) {
    case Expression::Kind::Name:
    case Expression::Kind::Direct:
      return true;
    case Expression::Kind::Member:
    case Expression::Kind::Bit:
    case Expression::Kind::Index:
      return is_designator(expression.operands[0]);
    case Expression::Kind::Deref:  // also of a call that returns a reference
      return expression.operands[0].kind == Expression::Kind::Call || is_designator(expression.operands[0]);
    case Expression::Kind::Literal:
    case Expression::Kind::Call:
    case Expression::Kind::Unary:
    case Expression::Kind::Binary:
      break;
  }
  return false;
}

const Expression& root_of(const Expression& expression) noexcept {
  const Expression* at = &expression;
  while (!at->operands.empty() && (!at->resolved || at->resolved->meaning == Meaning::Value)) {
    at = &at->operands[0];
  }
  return *at;
}

const Expression* through_pointer(const Expression& expression) noexcept {
  for (const Expression* at = &expression; !at->operands.empty(); at = &at->operands[0]) {
    const Type* base = at->operands[0].type;
    const Resolved* of = at->operands[0].resolved.get();
    const bool own = of != nullptr && (of->meaning == Meaning::This || of->meaning == Meaning::Super);
    const bool follows = (at->kind == Expression::Kind::Deref && !own) ||
                         (at->kind == Expression::Kind::Index && base != nullptr && base->kind == Type::Kind::Pointer);
    if (follows) {
      return &at->operands[0];
    }
  }
  return nullptr;
}

}  // namespace indurop::plc
