// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/foreign_types.h"

#include <algorithm>
#include <map>
#include <set>
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

const Type* named(Context& context, const schema::Type& type) {
  if (const auto known = context.program.foreign_types.find(type.name); known != context.program.foreign_types.end()) {
    return known->second;
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
  context.program.foreign_types.emplace(type.name, added);
  // A type of the program with this name takes precedence.
  std::string key = upper(added->name);
  if (context.program.type_names.contains(key)) {
    key = upper(added->shared_name);
  }
  context.program.type_names.emplace(key, added);
  return added;
}

}  // namespace

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

namespace {

// Returns "PRESS.MODE" for "press::Mode".
std::string path_in_capitals(std::string_view full) {
  std::string out;
  for (std::size_t i = 0; i < full.size(); ++i) {
    const bool space = full.substr(i, 2) == "::";
    out += space ? '.' : full[i];
    i += space ? 1 : 0;
  }
  return upper(out);
}

// Adds the type under its full name and its last one; null: the name is ambiguous.
void remember(std::map<std::string, const schema::Type*>& names, const std::string& path, const schema::Type& type) {
  for (const std::string& name : {path, path.substr(path.rfind('.') + 1)}) {
    const auto [known, is_new] = names.emplace(name, &type);
    if (!is_new && (known->second == nullptr || known->second->name != type.name)) {
      known->second = nullptr;
    }
  }
}

void collect_types(ForeignNames& names, std::set<std::string>& seen, const schema::Type& type) {
  if (type.name.empty() || !seen.insert(type.name).second) {
    return;
  }
  const std::string path = path_in_capitals(type.name);
  remember(names.types, path, type);
  const std::string space = path.substr(0, path.rfind('.') == std::string::npos ? 0 : path.rfind('.') + 1);
  for (const schema::Enumerator& one : type.enumerators) {
    remember(names.values, space + upper(one.name), type);
  }
  for (const schema::Field& field : type.fields) {
    collect_types(names, seen, field.type);
  }
}

// Returns the type without the dimensions of the variable that uses it.
const Type* single(Context& context, const schema::Type& type) {
  schema::Type one = type;
  one.dims.clear();
  return foreign_type(context, one);
}

}  // namespace

void index_foreign(Program& program) {
  ForeignNames& names = program.foreign_names;
  std::set<std::string> seen;
  for (const schema::Variable& one : program.foreign) {
    const std::string capitals = upper(one.name);
    names.variables.emplace(capitals, &one);
    names.last_names[capitals.substr(capitals.rfind(':') == std::string::npos ? 0 : capitals.rfind(':') + 1)].push_back(
        &one);
    for (std::size_t at = capitals.find("::"); at != std::string::npos; at = capitals.find("::", at + 2)) {
      names.spaces.insert(capitals.substr(0, at));
    }
    collect_types(names, seen, one.type);
  }
}

const Type* foreign_type_named(Context& context, std::string_view path) {
  const ForeignNames& names = context.program.foreign_names;
  const auto found = names.types.find(upper(path));
  return found == names.types.end() || found->second == nullptr ? nullptr : single(context, *found->second);
}

const Type* foreign_enum_value(Context& context, std::string_view path, std::int64_t& value) {
  const ForeignNames& names = context.program.foreign_names;
  const auto found = names.values.find(upper(path));
  if (found == names.values.end() || found->second == nullptr) {
    return nullptr;
  }
  const std::string_view name = path.substr(path.rfind('.') + 1);
  for (const schema::Enumerator& one : found->second->enumerators) {
    if (same_name(one.name, name)) {
      value = one.value;
    }
  }
  return single(context, *found->second);
}

}  // namespace indurop::plc
