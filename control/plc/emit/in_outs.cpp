// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/in_outs.h"

#include <fmt/format.h>

#include "control/plc/emit/cpp_text.h"

namespace indurop::plc {

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
