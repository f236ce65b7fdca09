// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/instance_contents.h"

namespace indurop::plc {

bool holds_instances(const Type& type) noexcept {
  return type.kind == Type::Kind::Block || (type.kind == Type::Kind::Array && holds_instances(*type.element));
}

bool is_placeless(const Variable& variable) noexcept {
  return variable.declared->address && variable.declared->address->numbers.empty() && variable.global == nullptr &&
         variable.owner != nullptr && variable.owner->is_block();
}

bool holds_places(const Type& type) {
  if (type.kind == Type::Kind::Array) {
    return holds_places(*type.element);
  }
  return type.kind == Type::Kind::Block && type.pou != nullptr && type.pou->holds_places;
}

}  // namespace indurop::plc
