// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/name_checker.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/check/global_table.h"
#include "control/plc/check/located_variables.h"
#include "control/plc/library/standard.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

bool is_global_list(const Program& program, std::string_view name) {
  const auto& lists = program.project.global_lists;
  return std::any_of(lists.begin(), lists.end(), [&](const std::string& list) { return same_name(list, name); });
}

// Returns the same id for types that differ in their initial value only.
std::string id_of(const Type& enumeration) {
  return upper(enumeration.name) + '|' + enumeration.shared_name;
}

void index_enumerations(Program& program) {
  for (; program.indexed_types < program.named_types.size(); ++program.indexed_types) {
    const Type* type = program.named_types[program.indexed_types];
    for (const EnumItem& item : type->items) {
      const std::string capitals = upper(item.name);
      const bool is_new = program.enum_values.try_emplace({id_of(*type), capitals}, type, item.value).second;
      if (auto& all = program.enums_of_value[capitals]; is_new && all.size() < 2) {
        all.push_back(type);
      }
    }
  }
}

const Pou* innermost_pou(const Type& type) noexcept {
  return type.element != nullptr ? innermost_pou(*type.element) : type.pou;
}

}  // namespace

// Long: one case for each kind of named item, in the order in which they hide each other.
const Type* NameChecker::name(Expression& expression, const Type* wanted) {
  Resolved& out = resolved(expression);
  const std::string capitals = upper(expression.name);
  Program& program = context_.program;
  if (!expression.value_enum.empty()) {
    const auto known = program.type_names.find(upper(expression.value_enum));
    const Type* type =
        known != program.type_names.end() ? known->second : foreign_type_named(context_, expression.value_enum);
    if (type == nullptr || type->kind != Type::Kind::Enum) {
      context_.error(expression.at, fmt::format("there is no enumeration '{}'", expression.value_enum));
      return nullptr;
    }
    return enum_value(expression, *type, expression.name);
  }
  const Pou* from = context_.pou == nullptr || !expression.of_this ? context_.pou : context_.pou->self();
  if (Variable* variable = from != nullptr ? from->find(capitals) : nullptr) {
    variable->used = true;
    variable->aliased = variable->aliased || variable->owner != context_.pou;
    if (!expressions_.methods().can_see(*variable, expression.at)) {
      return nullptr;
    }
    if (variable->global != nullptr) {
      return global(expression, *program.global_names.at(upper(variable->global->name)));
    }
    out.meaning = Meaning::Variable;
    out.variable = variable;
    out.constant = variable->constant;
    return variable->type;
  }
  if (context_.pou != nullptr && context_.pou->tree->result && same_name(context_.pou->name, expression.name)) {
    out.meaning = Meaning::FunctionResult;
    return context_.pou->result;
  }
  if (same_name(expression.name, "THIS") || same_name(expression.name, "SUPER")) {
    return expressions_.methods().this_or_super(expression);
  }
  if (from != nullptr && from->self() != nullptr && context_.program.has_objects) {
    const std::size_t before = context_.diagnostics.errors();
    if (const Pou* getter = expressions_.methods().accessor(*from->self(), expression, ast::Accessor::Get)) {
      return expressions_.methods().read_property(expression, *getter);
    }
    if (context_.diagnostics.errors() != before) {
      return nullptr;
    }
  }
  if (const auto found = program.global_names.find(capitals); found != program.global_names.end()) {
    return global(expression, *found->second);
  }
  if (Global* instance = program_named(expression.name)) {
    return global(expression, *instance);
  }
  if (const auto type = program.type_names.find(capitals); type != program.type_names.end()) {
    out.meaning = Meaning::Type;
    expression.type = type->second;
    return nullptr;
  }
  if (is_namespace(program, expression.name) || is_global_list(program, expression.name)) {
    out.meaning = Meaning::Namespace;
    out.path = expression.name;
    return nullptr;
  }
  return unknown(expression, wanted);
}

// Resolves a value of the required enumeration, else of the only one that has it. Null if none has it, or `both` do.
const Type* NameChecker::bare_enum_value(Expression& expression, const Type* wanted,
                                         std::pair<std::string, std::string>& both) {
  Program& program = context_.program;
  index_enumerations(program);
  const std::string capitals = upper(expression.name);
  if (wanted != nullptr && wanted->kind == Type::Kind::Enum) {
    if (const auto known = program.enum_values.find({id_of(*wanted), capitals}); known != program.enum_values.end()) {
      expression.resolved->constant = Integer{known->second.second};
      return known->second.first;
    }
  }
  const auto all = program.enums_of_value.find(capitals);
  if (all == program.enums_of_value.end()) {
    return nullptr;
  }
  const Type* first = all->second.front();
  expression.resolved->constant = Integer{program.enum_values.at({id_of(*first), capitals}).second};
  if (all->second.size() > 1) {
    both = {first->name, all->second[1]->name};
    return nullptr;
  }
  return first;
}

Global* NameChecker::program_named(std::string_view name) {
  Program& program = context_.program;
  const auto found = context_.codesys() ? program.pou_names.find(upper(name)) : program.pou_names.end();
  if (found == program.pou_names.end() || found->second->tree->kind != ast::Pou::Kind::Program) {
    return nullptr;
  }
  Pou& pou = *found->second;
  if (pou.instance == nullptr) {
    Type type;
    type.kind = Type::Kind::Block;
    type.name = pou.name;
    type.pou = &pou;
    Global global;
    global.kind = Global::Kind::Private;
    global.at = pou.tree->at;
    global.name = pou.name + "_program";
    while (program.global_names.contains(upper(global.name))) {
      global.name += "_1";
    }
    global.type = program.types.add(std::move(type));
    pou.instance = &program.globals.emplace_back(std::move(global));
  }
  return pou.instance;
}

const Type* NameChecker::enum_value(Expression& expression, const Type& type, std::string_view item) {
  index_enumerations(context_.program);
  const auto& values = context_.program.enum_values;
  if (const auto found = values.find({id_of(type), upper(item)}); found != values.end()) {
    resolved(expression).constant = Integer{found->second.second};
    return &type;
  }
  std::vector<std::string> known;
  for (const EnumItem& one : type.items) {
    if (same_name(one.name, item)) {
      resolved(expression).constant = Integer{one.value};
      return &type;
    }
    known.push_back(one.name);
  }
  context_.error(expression.at,
                 fmt::format("{} has no value '{}'{}", type.name, item, did_you_mean(context_, item, known)));
  return nullptr;
}

const Type* NameChecker::global(Expression& expression, Global& global) {
  Resolved& out = resolved(expression);
  out.meaning = Meaning::Global;
  out.global = &global;
  out.constant = global.constant;
  if (context_.pou != nullptr && expressions_.mode().reading) {
    context_.pou->globals[&global].read = true;
  }
  if (const Pou* instance = context_.pou != nullptr && global.type != nullptr ? innermost_pou(*global.type) : nullptr) {
    context_.pou->uses.insert(instance);
  }
  return global.type;
}

const Type* NameChecker::direct(Expression& expression) {
  if (expression.address.numbers.empty()) {
    context_.error(expression.at, fmt::format("{} is incomplete, which is allowed only after AT in a declaration",
                                              ast::to_string(expression.address)));
    return nullptr;
  }
  return global(expression, located_global(context_, expression.address, expression.at));
}

const Type* NameChecker::member(Expression& expression) {
  Expression& base = expression.operands[0];
  const Type* type = expressions_.typed(base, nullptr);
  if (type == nullptr) {
    if (base.resolved->meaning == Meaning::Namespace) {
      return namespace_member(expression, base.resolved->path);
    }
    if (base.resolved->meaning == Meaning::Type && base.type->kind == Type::Kind::Enum) {
      return enum_value(expression, *base.type, expression.name);
    }
    return nullptr;
  }
  if (expressions_.methods().variable_of_this(expression)) {
    return expressions_.typed(expression, nullptr);
  }
  if (type->pou != nullptr && (type->kind == Type::Kind::Block || type->kind == Type::Kind::Interface)) {
    const std::size_t before = context_.diagnostics.errors();
    const Pou* getter = type->pou->find(upper(expression.name)) == nullptr
                            ? expressions_.methods().accessor(*type->pou, expression, ast::Accessor::Get)
                            : nullptr;
    if (getter != nullptr) {
      return expressions_.methods().read_property(expression, *getter);
    }
    if (context_.diagnostics.errors() != before) {
      return nullptr;
    }
  }
  if (type->kind == Type::Kind::Block) {
    return block_member(expression, *type);
  }
  if (type->kind == Type::Kind::Enum) {
    return enum_value(expression, *type, expression.name);  // e.Red, where e is a variable
  }
  if (type->kind == Type::Kind::Elementary && !type->is_text()) {
    return named_bit(expression, *type);
  }
  if (const auto found = type->field_names.find(upper(expression.name)); found != type->field_names.end()) {
    const Field& field = type->fields[found->second];
    expression.name = field.member();
    return field.type;
  }
  std::vector<std::string> known;
  for (const Field& field : type->fields) {
    if (field.member() == expression.name) {  // checked before
      return field.type;
    }
    if (!context_.diagnostics.full()) {
      known.push_back(field.name);
    }
  }
  context_.error(expression.at, fmt::format("{} has no member '{}'{}", with_article(*type), expression.name,
                                            did_you_mean(context_, expression.name, known)));
  return nullptr;
}

// Resolves w.RUNNING, where RUNNING is a CONSTANT: the bit of that number.
const Type* NameChecker::named_bit(Expression& expression, const Type& base) {
  const std::string capitals = upper(expression.name);
  const Constant* known = nullptr;
  if (Variable* local = context_.pou != nullptr ? context_.pou->find(capitals) : nullptr) {
    local->used = true;
    known = local->constant ? &*local->constant : nullptr;
  } else if (const auto global = context_.program.global_names.find(capitals);
             global != context_.program.global_names.end()) {
    known = global->second->constant ? &*global->second->constant : nullptr;
  }
  const auto number = known != nullptr ? as_int64(*known) : std::nullopt;
  if (!number || *number < 0 || *number > 63) {
    context_.error(expression.at, fmt::format("{} has no member '{}'; a bit of it is a number or a CONSTANT: x.3",
                                              with_article(base), expression.name));
    return nullptr;
  }
  expression.kind = Expression::Kind::Bit;
  expression.bit = static_cast<unsigned>(*number);
  return expressions_.typed(expression, nullptr);
}

const Type* NameChecker::library_pin(Expression& expression, const LibraryBlock& block) {
  const LibraryParameter* output = block.output(expression.name);
  const LibraryParameter* found = output != nullptr ? output : block.input(expression.name);
  if (found == nullptr) {
    return nullptr;
  }
  resolved(expression).is_output = found == output;
  expression.name = found->cpp;
  return context_.elementary(std::get<Elementary>(found->type));
}

const Type* NameChecker::block_member(Expression& expression, const Type& block) {
  if (block.block != nullptr) {
    if (const Type* pin = library_pin(expression, *block.block)) {
      return pin;
    }
  } else if (block.pou != nullptr) {
    Variable* found = block.pou->find(upper(expression.name));
    if (found != nullptr) {
      found->used = true;  // even if only from outside
      found->aliased = true;
    }
    if (found != nullptr && (found->section == ast::Section::Input || found->section == ast::Section::Output)) {
      resolved(expression).is_output = found->section == ast::Section::Output;
      expression.name = found->name;
      return found->type;
    }
    if (found != nullptr && found->section == ast::Section::Local && found->declared->access == ast::Access::Public) {
      expression.name = found->name;
      return found->type;
    }
    if (found != nullptr && found->global != nullptr && found->section == ast::Section::Local && context_.codesys()) {
      return global(expression, *context_.program.global_names.at(upper(found->global->name)));
    }
    const bool inside = found != nullptr && found->section == ast::Section::Local && found->type != nullptr;
    if (inside && context_.codesys()) {
      resolved(expression).is_output = true;  // read, not written
      resolved(expression).constant = found->constant;
      expression.name = found->name;
      return found->type;
    }
    if (found != nullptr && found->section == ast::Section::InOut && expressions_.mode().reading &&
        context_.pou != nullptr) {
      // It is the variable that was passed to the preceding call.
      const auto given = context_.pou->given.find(upper(expression.operands[0].name + "." + expression.name));
      if (given != context_.pou->given.end()) {
        expression = ast::Expression(given->second);
        expression.resolved = nullptr;
        return expressions_.typed(expression, nullptr);
      }
    }
    if (found != nullptr && found->section == ast::Section::InOut) {
      context_.error(expression.at,
                     fmt::format("{} is VAR_IN_OUT of {} and here without a variable, call the instance before",
                                 found->name, to_string(block)));
      return nullptr;
    }
  }
  no_member(expression, block);
  return nullptr;
}

const Type* NameChecker::namespace_member(Expression& expression, const std::string& path) {
  const auto own = context_.program.global_names.find(upper(expression.name));
  if (is_global_list(context_.program, path) && own != context_.program.global_names.end()) {
    return global(expression, *own->second);
  }
  const std::string full = path + "::" + expression.name;
  if (Global* found = foreign_global(context_, full)) {
    return global(expression, *found);
  }
  if (is_namespace(context_.program, full)) {
    resolved(expression).meaning = Meaning::Namespace;
    resolved(expression).path = full;
    return nullptr;
  }
  const std::string dotted = ast::path_of(expression);  // press.Mode of press.Mode.PRESSING, press.PRESSING
  if (const Type* type = foreign_type_named(context_, dotted); type != nullptr && type->kind == Type::Kind::Enum) {
    resolved(expression).meaning = Meaning::Type;
    expression.type = type;
    return nullptr;
  }
  std::int64_t value = 0;
  if (const Type* type = foreign_enum_value(context_, dotted, value)) {
    resolved(expression).constant = Integer{value};
    return type;
  }
  const std::string shared = suggest_shared(context_.program, expression.name);
  context_.error(expression.at, fmt::format("there is no shared variable '{}'{}", full,
                                            shared.empty() ? "" : fmt::format(", did you mean '{}'?", shared)));
  return nullptr;
}

}  // namespace indurop::plc
