// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/located_variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/global_table.h"

namespace indurop::plc {
namespace {

// "IX0_3" of %IX0.3
std::string name_of(const ast::DirectAddress& address) {
  std::string name = ast::to_string(address);
  name.erase(0, 1);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

Elementary type_of(const ast::DirectAddress& address) noexcept {
  switch (address.size) {
    case 'B':
      return Elementary::Byte;
    case 'W':
      return Elementary::Word;
    case 'D':
      return Elementary::Dword;
    case 'L':
      return Elementary::Lword;
    default:
      return Elementary::Bool;
  }
}

unsigned bits_of_size(char size) noexcept {
  return bits_of(type_of({'I', size, {}}));
}

// "%IX0." of %IX0.3
std::string area_of(ast::DirectAddress address) {
  address.numbers.back() = 0;
  std::string text = ast::to_string(address);
  text.pop_back();
  return text;
}

// Makes the variable known by its address.
Global& place(Program& program, const ast::DirectAddress& address, Global& global) {
  if (!address.numbers.empty()) {
    program.addresses.emplace(global.address, &global);
    program.areas[area_of(address)].emplace(address.numbers.back(), &global);
  }
  return global;
}

Global* at_address(Program& program, const std::string& address) {
  const auto found = program.addresses.find(address);
  return found == program.addresses.end() ? nullptr : found->second;
}

// Returns a name for a variable that is not shared because another one has its name.
std::string free_name(const Program& program, std::string name) {
  while (program.global_names.contains(upper(name))) {
    name += "_1";
  }
  return name;
}

// Returns whether the size letter of the address matches the type.
bool lies_at(const Type& type, const ast::DirectAddress& address) noexcept {
  return type.kind <= Type::Kind::Enum && !type.is_text() && bits_of(type.elementary) == bits_of_size(address.size);
}

// Returns an array at an address that contains this address.
const Global* covering_array(const Program& program, const ast::DirectAddress& address) {
  const auto area = address.numbers.empty() ? program.areas.end() : program.areas.find(area_of(address));
  if (area == program.areas.end()) {
    return nullptr;
  }
  constexpr int kMaxBefore = 1000;  // single variables that may come before it; more would be an error
  auto at = area->second.upper_bound(address.numbers.back());
  for (int i = 0; i < kMaxBefore && at != area->second.begin(); ++i) {
    const auto& [number, one] = *--at;
    if (one->type->kind == Type::Kind::Array && lies_at(*one->type->element, address)) {
      return static_cast<std::uint64_t>(address.numbers.back() - number) < one->type->parts ? one : nullptr;
    }
  }
  return nullptr;
}

// Returns another variable that overlaps this one, if one of the two is an array.
const Global* overlapping(const Program& program, const ast::DirectAddress& address, const Type& type) {
  if (const Global* array = covering_array(program, address)) {
    return array;
  }
  if (type.kind != Type::Kind::Array || !lies_at(*type.element, address)) {
    return nullptr;
  }
  const auto area = program.areas.find(area_of(address));
  if (area == program.areas.end()) {
    return nullptr;
  }
  const auto found = area->second.upper_bound(address.numbers.back());
  const bool inside =
      found != area->second.end() && static_cast<std::uint64_t>(found->first - address.numbers.back()) < type.parts;
  return inside ? found->second : nullptr;
}

}  // namespace

// Declares AT %I*: a shared variable of the declared name.
Global* declare_placeless(Context& context, ast::Variable& variable, const Type& type) {
  if (context.pou != nullptr && context.pou->tree->kind != ast::Pou::Kind::Program) {
    context.error(variable.at, fmt::format("AT {} has no place in a call, declare it in a program or function block",
                                           ast::to_string(*variable.address)));
    return nullptr;
  }
  const auto address = std::exchange(variable.address, std::nullopt);
  const std::string before = variable.name;
  variable.name = context.pou != nullptr ? free_name(context.program, before) : before;
  Global* made = declare_variable(context, variable, type);
  variable.name = before;
  variable.address = address;
  if (made != nullptr) {
    made->address = ast::to_string(*address);
  }
  return made;
}

Global& declare_located(Context& context, ast::Variable& variable, const Type& type) {
  const Type& one = type.kind == Type::Kind::Array ? *type.element : type;  // an array occupies further addresses
  if (!lies_at(one, *variable.address) && !(context.codesys() && variable.address->size == 'B' && !is_private(one))) {
    context.error(variable.at, fmt::format("{} does not lie at {}, use the size letter of its type: X B W D L",
                                           with_article(type), ast::to_string(*variable.address)));
  }
  if (Global* known = at_address(context.program, ast::to_string(*variable.address))) {
    if (!same_type(*known->type, type)) {
      context.error(variable.at, fmt::format("{} is {} at {}, use one type", known->address, with_article(*known->type),
                                             to_string(known->at)));
    }
    if (context.pou == nullptr && !variable.name.empty()) {
      context.program.global_names.emplace(upper(variable.name), known);  // an additional name for it
    }
    return *known;
  }
  if (const Global* other = overlapping(context.program, *variable.address, type)) {
    context.error(variable.at, fmt::format("{} and '{}' at {} share places, use the elements of the array",
                                           variable.name.empty() ? ast::to_string(*variable.address)
                                                                 : fmt::format("'{}'", variable.name),
                                           other->name, other->address));
  }
  const std::string wanted = variable.name.empty() ? name_of(*variable.address) : variable.name;
  const std::string before = variable.name;
  variable.name = context.pou != nullptr ? free_name(context.program, wanted) : wanted;
  Global* made = declare_variable(context, variable, type);
  variable.name = before.empty() ? variable.name : before;
  return made != nullptr ? place(context.program, *variable.address, *made)
                         : located_global(context, *variable.address, variable.at);
}

Global& located_global(Context& context, const ast::DirectAddress& address, const Place& at) {
  const std::string text = ast::to_string(address);
  if (const Global* array = covering_array(context.program, address)) {
    context.error(at,
                  fmt::format("{} lies in the array '{}' at {}, write its element", text, array->name, array->address));
  }
  if (Global* known = at_address(context.program, text)) {
    return *known;
  }
  Global global;
  global.at = at;
  global.name = free_name(context.program, name_of(address));
  global.type = context.elementary(type_of(address));
  global.address = text;
  global.shared_name = fmt::format("{}::{}", context.program.space, free_shared_name(context.program, global.name));
  return place(context.program, address, add_global(context.program, std::move(global)));
}

}  // namespace indurop::plc
