// SPDX-License-Identifier: Apache-2.0
#include "plc/check/late_value.h"

#include <algorithm>
#include <utility>

namespace indurop::plc {
namespace {

using ast::Section;
using Kind = ast::Expression::Kind;

// Names are those of constants, unless they stand for places.
bool is_known_early(const ast::Expression& expression, bool is_place) {
  const bool name = expression.kind == Kind::Name || expression.kind == Kind::Member;
  if (expression.kind == Kind::Call || expression.kind == Kind::Deref ||
      (name && is_place && !same_name(expression.name, "NULL"))) {
    return false;
  }
  return std::all_of(expression.operands.begin(), expression.operands.end(),
                     [&](const ast::Expression& one) { return is_known_early(one, is_place); });
}

}  // namespace

void set_late_value(ast::Variable& declared, const Type& type, const Pou& pou) {
  const bool is_place = type.kind == Type::Kind::Pointer || type.kind == Type::Kind::Interface;
  const bool own = declared.section == Section::Local || declared.section == Section::Temp ||
                   (declared.section == Section::Output && !pou.is_callable());
  const bool kept = declared.constant || declared.is_static || declared.of_instance || declared.retain;
  if (own && !kept && !declared.address && declared.initial && declared.initial->value &&
      !is_known_early(*declared.initial->value, is_place)) {
    declared.late = std::move(declared.initial->value);
    declared.initial.reset();
  }
}

}  // namespace indurop::plc
