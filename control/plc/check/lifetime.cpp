// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/lifetime.h"

#include "control/plc/check/designator.h"

namespace indurop::plc {
namespace {

// Also true for VAR_IN_OUT of functions and methods, whatever they refer to.
bool is_of_call(const Variable& variable) {
  const bool callable =
      variable.owner->is_callable() && !variable.declared->is_static && !variable.declared->of_instance;
  return callable || variable.section == ast::Section::Temp;
}

}  // namespace

bool outlasts_call(const ast::Expression& expression) {
  if (expression.kind == ast::Expression::Kind::Deref ||
      (expression.type != nullptr && expression.type->is_reference())) {
    return false;
  }
  const Resolved& resolved = *expression.resolved;
  if (resolved.meaning == Resolved::Meaning::Value && !expression.operands.empty()) {
    return outlasts_call(expression.operands[0]);
  }
  const Variable* variable = resolved.variable;
  if (resolved.meaning != Resolved::Meaning::Variable || variable == nullptr) {
    return resolved.meaning != Resolved::Meaning::FunctionResult && resolved.meaning != Resolved::Meaning::Value;
  }
  const bool leads = variable->type != nullptr && variable->type->kind == Type::Kind::Pointer;
  return !leads && !is_of_call(*variable) && variable->section != ast::Section::InOut;
}

bool ends_with_call(const ast::Expression& expression) {
  const Resolved* root = root_of(expression).resolved.get();
  if (root == nullptr || through_pointer(expression) != nullptr) {
    return false;
  }
  const bool result = root->meaning == Resolved::Meaning::FunctionResult;
  return result || (root->meaning == Resolved::Meaning::Variable && root->variable != nullptr &&
                    root->variable->section != ast::Section::InOut && is_of_call(*root->variable));
}

void check_lifetime(Context& context, const ast::Statement& one) {
  const ast::Expression& value = *one.value;
  const bool address = value.resolved && value.resolved->intrinsic == Resolved::Intrinsic::Address;
  const bool instance = value.type != nullptr && value.type->kind == Type::Kind::Block;
  const ast::Expression& of = address ? *value.arguments[0].value : value;
  if (!(address || instance) || !ends_with_call(of)) {
    return;
  }
  const bool kept = one.target->resolved->meaning == Resolved::Meaning::FunctionResult ||
                    !(ends_with_call(*one.target) || through_pointer(*one.target) != nullptr);
  if (kept && address) {
    context.warning(value.at,
                    "this variable is gone when the call is over, and using the pointer then is a fault; "
                    "declare it as a variable of the instance if it is to stay");
  } else if (kept) {
    context.error(value.at,
                  "this instance is gone when the call is over, and the interface would lead to nothing; "
                  "declare it as a variable of the instance");
  }
}

}  // namespace indurop::plc
