// SPDX-License-Identifier: Apache-2.0
#include "plc/check/places.h"

#include <algorithm>
#include <array>

#include "plc/library/standard.h"

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
  if (type.kind != Type::Kind::Block || type.pou == nullptr) {
    return false;
  }
  const auto variables = all_variables(*type.pou);
  return std::any_of(variables.begin(), variables.end(), [](const Variable* one) {
    return is_placeless(*one) || (one->type != nullptr && one->section != ast::Section::InOut &&
                                  one->section != ast::Section::External && holds_places(*one->type));
  });
}

const LibraryBlock* forgetful_block(const Type& type) {
  constexpr std::array<std::string_view, 5> kForgetful{"INTEGRAL", "DERIVATIVE", "PID", "RAMP", "RTC"};
  if (type.kind == Type::Kind::Array) {
    return forgetful_block(*type.element);
  }
  if (type.kind != Type::Kind::Block) {
    return nullptr;
  }
  if (type.block != nullptr) {
    const bool forgets = std::find(kForgetful.begin(), kForgetful.end(), type.block->name) != kForgetful.end();
    return forgets ? type.block : nullptr;
  }
  for (const Variable* one : all_variables(*type.pou)) {
    const LibraryBlock* found =
        one->type != nullptr && one->section == ast::Section::Local ? forgetful_block(*one->type) : nullptr;
    if (found != nullptr) {
      return found;
    }
  }
  return nullptr;
}

}  // namespace indurop::plc
