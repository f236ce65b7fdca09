// SPDX-License-Identifier: Apache-2.0
#include "plc/emit/in_outs.h"

#include <fmt/format.h>

#include "plc/emit/cpp_text.h"

namespace indurop::plc {

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
  const bool of_call =
      variable->owner->is_callable() && !variable->declared->is_static && !variable->declared->of_instance;
  return !leads && !of_call && variable->section != ast::Section::Temp && variable->section != ast::Section::InOut;
}

void forget_in_outs(const Type& block, const std::string& instance, TextWriter& out) {
  if (block.pou == nullptr) {
    return;
  }
  for (const Variable* one : all_variables(*block.pou)) {
    const std::string member = instance + "." + cpp_name(std::string_view(one->name));
    const bool inside = one->type != nullptr && one->type->kind == Type::Kind::Block && one->global == nullptr &&
                        one->section != ast::Section::InOut && one->section != ast::Section::Temp &&
                        !one->declared->is_static;
    if (one->in_methods) {
      out.line(member + " = nullptr;");
    } else if (inside) {
      forget_in_outs(*one->type, member, out);
    }
  }
}

}  // namespace indurop::plc
