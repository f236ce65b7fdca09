// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/late_value.h"

#include <algorithm>
#include <utility>

#include "control/plc/check/expression_checker.h"

namespace indurop::plc {
namespace {

using ast::Section;
// Returns true for a variable as an initial value, as CODESYS allows: nVal : INT := LowerLimit;
bool is_variable(const Context& context, const Pou& pou, const ast::Expression& name) {
  const std::string capitals = upper(name.name);
  if (const Variable* own = pou.find(capitals)) {
    return !own->is_constant;
  }
  const auto global = context.program.global_names.find(capitals);
  return global != context.program.global_names.end() && global->second->kind != Global::Kind::Fixed;
}

// Names are constants, unless they refer to places or the dialect allows variables.
bool is_known_early(const Context& context, const Pou& pou, const ast::Expression& expression, bool is_place) {
  const bool name = expression.kind == ast::Expression::Kind::Name || expression.kind == ast::Expression::Kind::Member;
  if (expression.kind == ast::Expression::Kind::Call || expression.kind == ast::Expression::Kind::Deref ||
      (name && is_place && !same_name(expression.name, "NULL")) ||
      (context.codesys() &&
       (expression.kind == ast::Expression::Kind::Index ||
        (expression.kind == ast::Expression::Kind::Name && is_variable(context, pou, expression))))) {
    return false;
  }
  return std::all_of(expression.operands.begin(), expression.operands.end(),
                     [&](const ast::Expression& one) { return is_known_early(context, pou, one, is_place); });
}

}  // namespace

void set_late_value(const Context& context, ast::Variable& declared, const Type& type, const Pou& pou) {
  const bool is_place = type.kind == Type::Kind::Pointer || type.kind == Type::Kind::Interface;
  const bool own = declared.section == Section::Local || declared.section == Section::Temp ||
                   (declared.section == Section::Output && !pou.is_callable());
  const bool kept = declared.constant || declared.is_static || declared.of_instance || declared.retain;
  if (own && !kept && !declared.address && declared.initial && declared.initial->value &&
      !is_known_early(context, pou, *declared.initial->value, is_place)) {
    declared.late = std::move(declared.initial->value);
    declared.initial.reset();
  }
}

void check_open_initials(Context& context) {
  for (const OpenInitial& one : std::exchange(context.open_initials, {})) {
    Pou* before = std::exchange(context.pou, one.pou);
    static_cast<void>(ExpressionChecker(context).initials().initial(*one.initial, *one.type));
    context.pou = before;
  }
}

}  // namespace indurop::plc
