// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/global_table.h"

#include <fmt/format.h>

#include <utility>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/check/instance_contents.h"
#include "control/plc/check/located_variables.h"
#include "control/plc/check/object_checker.h"
#include "control/plc/check/shared_names.h"
#include "control/plc/check/type_builder.h"

namespace indurop::plc {
namespace {

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

}  // namespace

Global& add_global(Program& program, Global global) {
  Global& added = program.globals.emplace_back(std::move(global));
  program.global_names.emplace(upper(added.name), &added);
  if (added.kind != Global::Kind::Foreign) {
    program.shared_names.insert(upper(last_name(added.shared_name)));
  } else if (added.foreign != nullptr) {
    program.foreign_globals.emplace(added.foreign, &added);
  }
  return added;
}

std::string free_shared_name(const Program& program, const std::string& name) {
  std::string shared = name_of_shared(name);
  while (program.shared_names.contains(upper(shared))) {
    shared += "_value";
  }
  return shared;
}

Global* declare_variable(Context& context, ast::Variable& variable, const Type& type) {
  Program& program = context.program;
  if (is_no_variable(context, variable, type)) {
    return nullptr;
  }
  if (const auto known = program.global_names.find(upper(variable.name)); known != program.global_names.end()) {
    context.error(variable.at, fmt::format("'{}' is already declared at {}, rename one of them", variable.name,
                                           to_string(known->second->at)));
    return nullptr;
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
    return nullptr;
  }
  if (!holds_instances(type) && !count_values(context, variable.at, type, global.initial)) {
    return nullptr;
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
  return &add_global(program, std::move(global));
}

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
    declare_variable(context, variable, *type);
  }
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
  return &add_global(program, std::move(global));
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
