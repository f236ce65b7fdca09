// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/initial_checker.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/value_tree.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

using Kind = ast::Initial::Kind;

}  // namespace

bool InitialChecker::initial(ast::Initial& initial, const Type& type) {
  if (initial.kind == Kind::Array) {
    return array_initial(initial, type);
  }
  if (initial.kind == Kind::Struct) {
    return struct_initial(initial, type);
  }
  if (type.kind == Type::Kind::Block || !expressions_.assigned(*initial.value, type)) {
    if (type.kind == Type::Kind::Block) {
      context_.error(initial.at, "an instance begins with values of its inputs: (PT := T#1s)");
    }
    return false;
  }
  if (constant_of(*initial.value) == nullptr) {
    context_.error(initial.at, "an initial value must be known now, use numbers and CONSTANTs");
    return false;
  }
  return true;
}

bool InitialChecker::array_initial(ast::Initial& initial, const Type& type) {
  if (type.kind != Type::Kind::Array) {
    context_.error(initial.at, fmt::format("[...] is for arrays, not for {}", with_article(type)));
    return false;
  }
  std::uint64_t count = 0;
  bool fine = true;
  for (ast::InitialElement& element : initial.elements) {
    std::int64_t repeat = 1;
    if (element.count) {
      repeat = expressions_.constant(*element.count, "the number of repetitions").value_or(0);
    }
    fine = repeat >= 0 && this->initial(element.value, *type.element) && fine;
    count += static_cast<std::uint64_t>(std::clamp<std::int64_t>(repeat, 0, std::numeric_limits<std::int32_t>::max()));
  }
  if (fine && count > elements_of(type)) {
    context_.error(initial.at, fmt::format("{} values for {} elements, remove some", count, elements_of(type)));
    return false;
  }
  return fine;
}

bool InitialChecker::struct_initial(ast::Initial& initial, const Type& type) {
  bool fine = true;
  if (type.overlaps) {
    context_.error(initial.at, "a UNION begins with zeros, assign its fields in the body");
    return false;
  }
  for (ast::InitialElement& element : initial.elements) {
    const Type* field_type = nullptr;
    if (const auto found = type.field_names.find(upper(element.field)); found != type.field_names.end()) {
      const Field& field = type.fields[found->second];
      field_type = field.type;
      element.field = field.name;
    }
    if (type.kind == Type::Kind::Block && type.block != nullptr) {
      if (const LibraryParameter* input = type.block->input(element.field)) {
        field_type = context_.elementary(std::get<Elementary>(input->type));
        element.field = input->cpp;
      }
    } else if (type.kind == Type::Kind::Block) {
      const Variable* input = type.pou->find(upper(element.field));
      const bool is_public =
          input != nullptr && input->section == ast::Section::Local && input->declared->access == ast::Access::Public;
      if (is_public ||
          (input != nullptr && (input->section == ast::Section::Input || input->section == ast::Section::Output))) {
        field_type = input->type;
        element.field = input->name;
      }
    }
    if (field_type == nullptr) {
      context_.error(element.value.at,
                     fmt::format("{} has no field '{}' to begin with", to_string(type), element.field));
      fine = false;
      continue;
    }
    fine = this->initial(element.value, *field_type) && fine;
  }
  return fine;
}

}  // namespace indurop::plc
