// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/global_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/check/instance_contents.h"
#include "control/plc/check/object_checker.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/check/type_builder.h"
#include "control/plc/st/literal.h"

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

Global& add(Program& program, Global global) {
  Global& added = program.globals.emplace_back(std::move(global));
  program.global_names.emplace(upper(added.name), &added);
  if (added.kind != Global::Kind::Foreign) {
    program.shared_names.insert(upper(last_name(added.shared_name)));
  } else if (added.foreign != nullptr) {
    program.foreign_globals.emplace(added.foreign, &added);
  }
  if (const auto address = st::address_literal(added.address); address && !address->numbers.empty()) {
    program.addresses.emplace(added.address, &added);
    program.areas[area_of(*address)].emplace(address->numbers.back(), &added);
  }
  return added;
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

// Returns the name of a variable outside of the program: its own, unless that is taken there.
std::string free_shared_name(const Program& program, const std::string& name) {
  std::string shared = name_of_shared(name);
  while (program.shared_names.contains(upper(shared))) {
    shared += "_value";
  }
  return shared;
}

// Returns true, with an error, for types that can only be passed to a call, or be extended.
bool is_no_variable(Context& context, const ast::Variable& variable, const Type& type) {
  if (type.open) {
    context.error(variable.at, kOpenArray);
    return true;
  }
  const Type& one = type.kind == Type::Kind::Array ? *type.element : type;
  if (one.kind == Type::Kind::Block && one.pou != nullptr && one.pou->tree->is_abstract) {
    context.error(variable.at, abstract_instance(*one.pou));
    return true;
  }
  return false;
}

void declare_one(Context& context, ast::Variable& variable, const Type& type) {
  Program& program = context.program;
  if (is_no_variable(context, variable, type)) {
    return;
  }
  if (variable.name.empty()) {
    variable.name = name_of(*variable.address);
  }
  if (const auto known = program.global_names.find(upper(variable.name)); known != program.global_names.end()) {
    context.error(variable.at, fmt::format("'{}' is already declared at {}, rename one of them", variable.name,
                                           to_string(known->second->at)));
    return;
  }
  Global global;
  global.at = variable.at;
  global.name = variable.name;
  global.type = &type;
  global.retain = variable.retain;
  global.comment = variable.comment;
  global.initial = variable.initial ? &*variable.initial : nullptr;
  global.address = variable.address ? ast::to_string(*variable.address) : "";
  if (variable.initial && holds_instances(type)) {
    context.open_initials.push_back({&*variable.initial, &type, nullptr});
  } else if (variable.initial && !ExpressionChecker(context).initials().initial(*variable.initial, type)) {
    context.known_errors.insert({nullptr, upper(variable.name)});
    return;
  }
  if (!holds_instances(type) && !count_values(context, variable.at, type, global.initial)) {
    return;
  }
  if (variable.constant && !variable.initial) {
    context.error(variable.at, "a CONSTANT needs a value: name : INT := 5;");
  }
  if (variable.constant) {
    global.kind = Global::Kind::Fixed;
    const bool scalar = variable.initial && variable.initial->value && type.kind == Type::Kind::Elementary;
    const Constant* known = scalar ? constant_of(*variable.initial->value) : nullptr;
    global.constant = known != nullptr && !type.is_text() ? std::optional(stored(*known, type)) : std::nullopt;
  } else if (is_private(type)) {
    if (variable.retain && !holds_instances(type)) {
      context.error(variable.at, fmt::format("{} cannot be kept over a restart, remove RETAIN", with_article(type)));
    }
    global.kind = Global::Kind::Private;
  }
  global.shared_name = fmt::format("{}::{}", program.space, free_shared_name(program, global.name));
  if (!global.shared_name.ends_with("::" + global.name) && global.kind == Global::Kind::Own) {
    context.warning(variable.at,
                    fmt::format("'{}' has another meaning in C++ or IDL, so modules and tools see it as {}",
                                global.name, global.shared_name));
  }
  add(program, std::move(global));
}

// Returns whether an external may access the shared variable as its declared type: another number of the same size, or
// BOOL.
bool can_show(const Type& as, const Type& of) noexcept {
  if (as.kind != Type::Kind::Elementary || of.kind > Type::Kind::Enum) {
    return same_type(as, of);
  }
  const auto countable = [](Elementary type) {
    return is_int(type) || is_bit(type) || type == Elementary::Time || is_date(type);
  };
  const Elementary other = of.kind == Type::Kind::Enum ? Elementary::Dint : of.elementary;
  return as.elementary == other || (countable(as.elementary) && countable(other) &&
                                    (bits_of(as.elementary) == bits_of(other) || as.is(Elementary::Bool)));
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

void declare_global(Context& context, ast::Variable& variable) {
  const Type* type = build_type(context, variable.type);
  if (type == nullptr || !count_fields(context, variable.at, *type)) {
    context.known_errors.insert({nullptr, upper(variable.name)});
    return;
  }
  if (variable.address && variable.address->numbers.empty()) {
    declare_placeless(context, variable, *type);
  } else if (variable.address) {
    declare_located(context, variable, *type);
  } else {
    declare_one(context, variable, *type);
  }
}

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
  declare_one(context, variable, type);
  const auto made = context.program.global_names.find(upper(variable.name));
  variable.name = before;
  variable.address = address;
  if (made == context.program.global_names.end()) {
    return nullptr;
  }
  made->second->address = ast::to_string(*address);
  return made->second;
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
  declare_one(context, variable, type);
  variable.name = before.empty() ? variable.name : before;
  Global* made = at_address(context.program, ast::to_string(*variable.address));
  return made != nullptr ? *made : located_global(context, *variable.address, variable.at);
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
  return add(context.program, std::move(global));
}

Global* foreign_global(Context& context, std::string_view full_name) {
  Program& program = context.program;
  const auto named = program.foreign_names.variables.find(upper(full_name));
  if (named == program.foreign_names.variables.end()) {
    return nullptr;
  }
  const schema::Variable* found = named->second;
  if (const auto known = program.foreign_globals.find(found); known != program.foreign_globals.end()) {
    return known->second;
  }
  Global global;
  global.kind = Global::Kind::Foreign;
  global.name = found->name;
  global.shared_name = found->name;
  global.foreign = found;
  global.type = foreign_type(context, found->type);
  return &add(program, std::move(global));
}

Global* only_foreign_global(Context& context, std::string_view name) {
  const auto& names = context.program.foreign_names.last_names;
  const auto found = names.find(upper(name));
  return found == names.end() || found->second.size() != 1 ? nullptr
                                                           : foreign_global(context, found->second.front()->name);
}

Global* external_global(Context& context, const ast::Variable& variable, const Type& type) {
  Program& program = context.program;
  if (const auto known = program.global_names.find(upper(variable.name)); known != program.global_names.end()) {
    if (!same_type(*known->second->type, type)) {
      context.error(variable.at,
                    fmt::format("'{}' is {}, declare it as that", variable.name, with_article(*known->second->type)));
    }
    return known->second;
  }
  const auto named = program.foreign_names.last_names.find(upper(variable.name));
  const auto found =
      named == program.foreign_names.last_names.end() ? std::vector<const schema::Variable*>() : named->second;
  if (found.size() != 1) {
    context.error(variable.at,
                  found.empty()
                      ? fmt::format("there is no VAR_GLOBAL '{0}' and no shared variable of this name; declare "
                                    "it, or name its .glb file with --glb",
                                    variable.name)
                      : fmt::format("'{}' may be {} or {}, write the name with its namespace in the program",
                                    variable.name, found[0]->name, found[1]->name));
    return nullptr;
  }
  Global& global = *foreign_global(context, found[0]->name);
  if (!can_show(type, *global.type)) {
    context.error(variable.at, fmt::format("{} is {}, declare '{}' as that", global.shared_name,
                                           with_article(*global.type), variable.name));
  }
  global.type = &type;
  global.name = variable.name;
  program.global_names.emplace(upper(variable.name), &global);
  return &global;
}

bool is_namespace(const Program& program, std::string_view path) {
  return program.foreign_names.spaces.contains(upper(path));
}

std::string suggest_shared(const Program& program, std::string_view name) {
  const auto named = program.foreign_names.last_names.find(upper(name));
  if (named == program.foreign_names.last_names.end() || named->second.size() != 1) {
    return "";
  }
  std::string found = named->second.front()->name;
  for (std::size_t at = found.find("::"); at != std::string::npos; at = found.find("::")) {
    found.erase(at, 1);
    found[at] = '.';
  }
  return found;
}

}  // namespace indurop::plc
