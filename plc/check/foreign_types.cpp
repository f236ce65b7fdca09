// SPDX-License-Identifier: Apache-2.0
#include "plc/check/foreign_types.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

namespace indurop::plc {
namespace {

Elementary elementary_of(schema::Base base) noexcept {
  switch (base) {
    case schema::Base::Bool:
      return Elementary::Bool;
    case schema::Base::Int8:
      return Elementary::Sint;
    case schema::Base::Char:
    case schema::Base::UInt8:
      return Elementary::Usint;
    case schema::Base::Int16:
      return Elementary::Int;
    case schema::Base::UInt16:
      return Elementary::Uint;
    case schema::Base::Int32:
    case schema::Base::Enum:
    case schema::Base::Struct:
      return Elementary::Dint;
    case schema::Base::UInt32:
      return Elementary::Udint;
    case schema::Base::Int64:
      return Elementary::Lint;
    case schema::Base::UInt64:
      return Elementary::Ulint;
    case schema::Base::Float:
      return Elementary::Real;
    case schema::Base::Double:
      return Elementary::Lreal;
    case schema::Base::Text:
      return Elementary::String;
  }
  return Elementary::Dint;
}

const Type* known_type(const Program& program, const std::string& shared_name) {
  for (const auto& [name, type] : program.type_names) {
    if (type->shared_name == shared_name) {
      return type;
    }
  }
  return nullptr;
}

const Type* named(Context& context, const schema::Type& type) {
  if (const Type* known = known_type(context.program, type.name)) {
    return known;
  }
  Type made;
  made.kind = type.base == schema::Base::Enum ? Type::Kind::Enum : Type::Kind::Struct;
  made.elementary = Elementary::Dint;
  made.name = type.name.substr(type.name.rfind(':') + 1);
  made.shared_name = type.name;
  for (const schema::Enumerator& one : type.enumerators) {
    made.items.push_back({one.name, one.value});
  }
  for (const schema::Field& field : type.fields) {
    made.fields.push_back({field.name, foreign_type(context, field.type), nullptr, field.description});
  }
  Type* added = context.program.types.add(std::move(made));
  context.program.named_types.push_back(added);
  // The program's own type of this name is found first.
  std::string key = upper(added->name);
  if (context.program.type_names.contains(key)) {
    key = upper(added->shared_name);
  }
  context.program.type_names.emplace(key, added);
  return added;
}

// Adds the types of this name in `type` and in what it is made of.
void find_named(const schema::Type& type, std::string_view name, std::map<std::string, const schema::Type*>& found) {
  if (same_name(type.name.substr(type.name.rfind(':') + 1), name)) {
    found.emplace(type.name, &type);
  }
  for (const schema::Field& field : type.fields) {
    find_named(field.type, name, found);
  }
}

}  // namespace

const Type* foreign_type_named(Context& context, std::string_view name) {
  std::map<std::string, const schema::Type*> found;
  for (const schema::Variable& one : context.program.foreign) {
    find_named(one.type, name, found);
  }
  return found.size() == 1 ? named(context, *found.begin()->second) : nullptr;
}

const Type* foreign_type(Context& context, const schema::Type& type) {
  const Type* element = nullptr;
  if (type.base == schema::Base::Struct || type.base == schema::Base::Enum) {
    element = named(context, type);
  } else if (type.base == schema::Base::Text) {
    element = context.program.types.text(Elementary::String, std::max(type.text_size, 1U) - 1);
  } else {
    element = context.elementary(elementary_of(type.base));
  }
  if (type.dims.empty()) {
    return element;
  }
  Type array;
  array.kind = Type::Kind::Array;
  array.element = element;
  for (const std::uint32_t count : type.dims) {
    array.dimensions.push_back({0, static_cast<std::int64_t>(count) - 1});
  }
  return context.program.types.add(std::move(array));
}

}  // namespace indurop::plc
