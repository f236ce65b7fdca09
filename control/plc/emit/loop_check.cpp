// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/loop_check.h"

#include <algorithm>

namespace indurop::plc {
namespace {

using ast::Statement;

bool names(const ast::Expression& expression, const Variable& variable) noexcept {
  return expression.kind == ast::Expression::Kind::Name && expression.resolved &&
         expression.resolved->variable == &variable;
}

// Returns whether an assignment writes the variable: w.3 := TRUE writes w.
bool writes(const ast::Expression& target, const Variable& variable) noexcept {
  return names(target, variable) || (target.kind == ast::Expression::Kind::Bit && names(target.operands[0], variable));
}

// Returns whether its value is kept until the next call of its POU.
bool is_kept(const Variable& variable) noexcept {
  const Pou& owner = *variable.owner;
  return owner.is_callable() ? variable.declared->is_static || variable.declared->of_instance
                             : variable.section != ast::Section::Temp;
}

// Returns whether a call in it has the variable as an output, or may call this body again.
bool gives_away(const ast::Expression& expression, const Variable& variable) {
  const bool calls = expression.kind == ast::Expression::Kind::Call && expression.resolved &&
                     (expression.resolved->pou != nullptr || expression.resolved->by_super);
  const Pou* self = variable.owner->self();
  if (calls && self != nullptr && self->is_object && is_kept(variable)) {
    return true;
  }
  return std::any_of(expression.arguments.begin(), expression.arguments.end(),
                     [&](const ast::Argument& one) {
                       return one.value &&
                              ((one.output && writes(*one.value, variable)) || gives_away(*one.value, variable));
                     }) ||
         std::any_of(expression.operands.begin(), expression.operands.end(),
                     [&](const ast::Expression& one) { return gives_away(one, variable); });
}

bool statement_only_reads(const Statement& one, const Variable& variable) {
  if (one.kind == Statement::Kind::Return || one.kind == Statement::Kind::Jump) {
    return false;
  }
  const bool sets = one.kind == Statement::Kind::Assign || one.kind == Statement::Kind::For;
  if (sets && writes(*one.target, variable)) {
    return false;
  }
  for (const auto* part : {&one.target, &one.value, &one.to, &one.by}) {
    if (*part && gives_away(**part, variable)) {
      return false;
    }
  }
  return only_reads(one.body, variable) &&
         std::all_of(one.branches.begin(), one.branches.end(), [&](const auto& branch) {
           return only_reads(branch.body, variable) && (!branch.condition || !gives_away(*branch.condition, variable));
         });
}

}  // namespace

bool only_reads(const ast::Body& body, const Variable& variable) {
  return std::all_of(body.begin(), body.end(),
                     [&](const Statement& one) { return statement_only_reads(one, variable); });
}

}  // namespace indurop::plc
