// SPDX-License-Identifier: Apache-2.0
// What names mean: variables, members, values of enumerations, shared variables, addresses; and who writes what.

#include <fmt/format.h>

#include <algorithm>

#include "plc/check/expression_checker.h"
#include "plc/check/global_table.h"
#include "plc/library/standard.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

// What can stand left of := : a name, with members, indices and bits of it.
bool is_designator(const Expression& expression) noexcept {
  switch (expression.kind) {
    case Expression::Kind::Name:
    case Expression::Kind::Direct:
      return true;
    case Expression::Kind::Member:
    case Expression::Kind::Bit:
    case Expression::Kind::Index:
      return is_designator(expression.operands[0]);
    case Expression::Kind::Literal:
    case Expression::Kind::Call:
    case Expression::Kind::Unary:
    case Expression::Kind::Binary:
      break;
  }
  return false;
}

const Expression& root_of(const Expression& expression) noexcept {
  const Expression* at = &expression;
  while (!at->operands.empty() && (!at->resolved || at->resolved->meaning == Meaning::Value)) {
    at = &at->operands[0];
  }
  return *at;
}

// ".a.b" as far as it is fixed: an index and what is behind it do not count.
std::string path_of(const Expression& expression, bool& fixed) {
  if (expression.resolved && expression.resolved->meaning != Meaning::Value) {
    fixed = true;
    return "";
  }
  std::string path = path_of(expression.operands[0], fixed);
  fixed = fixed && expression.kind == Expression::Kind::Member;
  return fixed ? path + "." + expression.name : path;
}

bool is_global_list(const Program& program, std::string_view name) {
  const auto& lists = program.project.global_lists;
  return std::any_of(lists.begin(), lists.end(), [&](const std::string& list) { return same_name(list, name); });
}

}  // namespace

const Type* ExpressionChecker::name(Expression& expression) {
  Resolved& out = resolved(expression);
  const std::string capitals = upper(expression.name);
  Program& program = context_.program;
  if (!expression.value_enum.empty()) {
    const auto type = program.type_names.find(upper(expression.value_enum));
    if (type == program.type_names.end() || type->second->kind != Type::Kind::Enum) {
      context_.error(expression.at, fmt::format("there is no enumeration '{}'", expression.value_enum));
      return nullptr;
    }
    return enum_value(expression, *type->second, expression.name);
  }
  if (Variable* variable = context_.pou != nullptr ? context_.pou->find(capitals) : nullptr) {
    variable->used = true;
    if (variable->global != nullptr) {
      return global(expression, *program.global_names.at(upper(variable->global->name)));
    }
    out.meaning = Meaning::Variable;
    out.variable = variable;
    out.constant = variable->constant;
    return variable->type;
  }
  if (context_.pou != nullptr && context_.pou->result != nullptr && same_name(context_.pou->name, expression.name)) {
    out.meaning = Meaning::FunctionResult;
    return context_.pou->result;
  }
  if (const auto found = program.global_names.find(capitals); found != program.global_names.end()) {
    return global(expression, *found->second);
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
  return unknown(expression);
}

bool ExpressionChecker::counts_as_truth(const Expression& expression, const Type& type) noexcept {
  const Resolved* root = root_of(expression).resolved.get();
  const bool shared = root != nullptr && root->global != nullptr && root->global->kind == Global::Kind::Foreign;
  return expression.as_truth && shared && type.kind == Type::Kind::Elementary &&
         (is_int(type.elementary) || (is_bit(type.elementary) && !type.is(Elementary::Bool)));
}

// x <> 0
Expression& ExpressionChecker::make_truth(Expression& expression) {
  Expression number = std::move(expression);
  number.as_truth = false;
  Expression zero;
  zero.at = number.at;
  zero.value = std::uint64_t{0};
  expression = Expression{};
  expression.kind = Expression::Kind::Binary;
  expression.op = ast::Operator::NotEqual;
  expression.at = zero.at;
  expression.operands.push_back(std::move(number));
  expression.operands.push_back(std::move(zero));
  static_cast<void>(resolved(expression));
  return expression;
}

const Type* ExpressionChecker::unknown(Expression& expression) {
  const Type* found = nullptr;
  for (const Type* type : context_.program.named_types) {
    for (const EnumItem& item : type->items) {
      if (!same_name(item.name, expression.name)) {
        continue;
      }
      if (found != nullptr) {
        context_.error(expression.at, fmt::format("'{0}' is a value of {1} and of {2}, write {1}#{0} or {2}#{0}",
                                                  expression.name, found->name, type->name));
        return nullptr;
      }
      found = type;
      expression.resolved->constant = Integer{item.value};
    }
  }
  if (found != nullptr) {
    return found;
  }
  if (Global* shared = only_foreign_global(context_, expression.name)) {
    return global(expression, *shared);
  }
  if (const auto pou = context_.program.pou_names.find(upper(expression.name));
      pou != context_.program.pou_names.end() && pou->second->tree->kind == ast::Pou::Kind::Program) {
    context_.error(expression.at,
                   fmt::format("{} is a program, whose variables are its own; declare what others use as "
                               "VAR_GLOBAL",
                               pou->second->name));
    return nullptr;
  }
  std::vector<std::string> known;
  if (context_.pou != nullptr) {
    for (const Variable& variable : context_.pou->variables) {
      known.push_back(variable.name);
    }
  }
  for (const Global& one : context_.program.globals) {
    known.push_back(one.name);
  }
  const std::string hint = did_you_mean(expression.name, known);
  context_.error(expression.at, fmt::format("'{}' is not declared{}", expression.name,
                                            hint.empty() ? ", declare it between VAR and END_VAR" : hint));
  return nullptr;
}

const Type* ExpressionChecker::enum_value(Expression& expression, const Type& type, std::string_view item) {
  std::vector<std::string> known;
  for (const EnumItem& one : type.items) {
    if (same_name(one.name, item)) {
      resolved(expression).constant = Integer{one.value};
      return &type;
    }
    known.push_back(one.name);
  }
  context_.error(expression.at, fmt::format("{} has no value '{}'{}", type.name, item, did_you_mean(item, known)));
  return nullptr;
}

const Type* ExpressionChecker::global(Expression& expression, Global& global) {
  Resolved& out = resolved(expression);
  out.meaning = Meaning::Global;
  out.global = &global;
  out.constant = global.constant;
  if (context_.pou != nullptr && reading_) {
    context_.pou->globals[&global].read = true;
  }
  return global.type;
}

const Type* ExpressionChecker::direct(Expression& expression) {
  if (expression.address.numbers.empty()) {
    context_.error(expression.at, fmt::format("{} says no place, write it behind AT in a declaration only",
                                              ast::to_string(expression.address)));
    return nullptr;
  }
  return global(expression, located_global(context_, expression.address, expression.at));
}

const Type* ExpressionChecker::member(Expression& expression) {
  Expression& base = expression.operands[0];
  const Type* type = typed(base, nullptr);
  if (type == nullptr) {
    if (base.resolved->meaning == Meaning::Namespace) {
      return namespace_member(expression, base.resolved->path);
    }
    if (base.resolved->meaning == Meaning::Type && base.type->kind == Type::Kind::Enum) {
      return enum_value(expression, *base.type, expression.name);
    }
    return nullptr;
  }
  if (type->kind == Type::Kind::Block) {
    return block_member(expression, *type);
  }
  std::vector<std::string> known;
  for (const Field& field : type->fields) {
    if (same_name(field.name, expression.name) || field.member() == expression.name) {
      expression.name = field.member();
      return field.type;
    }
    known.push_back(field.name);
  }
  context_.error(expression.at, fmt::format("{} has no member '{}'{}", with_article(*type), expression.name,
                                            did_you_mean(expression.name, known)));
  return nullptr;
}

const Type* ExpressionChecker::block_member(Expression& expression, const Type& block) {
  std::vector<std::string> known;
  if (block.block != nullptr) {
    const LibraryParameter* output = block.block->output(expression.name);
    const LibraryParameter* found = output != nullptr ? output : block.block->input(expression.name);
    if (found != nullptr) {
      expression.name = found->cpp;
      resolved(expression).is_output = found == output;
      return context_.elementary(std::get<Elementary>(found->type));
    }
    for (const LibraryParameter& one : block.block->outputs) {
      known.push_back(one.name);
    }
  } else {
    const Variable* found = block.pou->find(upper(expression.name));
    if (found != nullptr && (found->section == ast::Section::Input || found->section == ast::Section::Output)) {
      resolved(expression).is_output = found->section == ast::Section::Output;
      expression.name = found->name;
      return found->type;
    }
    if (found != nullptr && found->section == ast::Section::InOut && reading_ && context_.pou != nullptr) {
      // It is the variable that the call above was given.
      const auto given = context_.pou->given.find(upper(expression.operands[0].name + "." + expression.name));
      if (given != context_.pou->given.end()) {
        expression = ast::Expression(given->second);
        expression.resolved = nullptr;
        return typed(expression, nullptr);
      }
    }
    if (found != nullptr && found->section == ast::Section::InOut) {
      context_.error(expression.at,
                     fmt::format("{} is VAR_IN_OUT of {} and here without a variable, call the instance before",
                                 found->name, to_string(block)));
      return nullptr;
    }
    for (const Variable& one : block.pou->variables) {
      if (one.section == ast::Section::Output) {
        known.push_back(one.name);
      }
    }
  }
  context_.error(expression.at, fmt::format("{} has no input or output '{}'{}", to_string(block), expression.name,
                                            did_you_mean(expression.name, known)));
  return nullptr;
}

const Type* ExpressionChecker::namespace_member(Expression& expression, const std::string& path) {
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
  const std::string shared = suggest_shared(context_.program, expression.name);
  context_.error(expression.at, fmt::format("there is no shared variable '{}'{}", full,
                                            shared.empty() ? "" : fmt::format(", did you mean '{}'?", shared)));
  return nullptr;
}

const Type* ExpressionChecker::target(Expression& expression) {
  const bool reading = std::exchange(reading_, expression.kind == Expression::Kind::Bit);
  const Type* type = value(expression);
  reading_ = reading;
  if (type == nullptr || !writable(expression)) {
    return nullptr;
  }
  note_write(expression);
  return type;
}

const Type* ExpressionChecker::reference(Expression& expression) {
  const Type* type = typed(expression, nullptr);
  if (type == nullptr || !writable(expression)) {
    return nullptr;
  }
  if (expression.kind == Expression::Kind::Bit) {
    context_.error(expression.at, "a single bit cannot be passed by reference, copy it to a BOOL first");
    return nullptr;
  }
  note_call(expression);
  note_write(expression);
  return type;
}

bool ExpressionChecker::writable(const Expression& expression) {
  const Expression& root = root_of(expression);
  const Meaning meaning = !is_designator(expression) ? Meaning::Value
                          : root.resolved            ? root.resolved->meaning
                                                     : Meaning::Value;
  if (meaning == Meaning::FunctionResult) {
    return true;
  }
  if (meaning != Meaning::Variable && meaning != Meaning::Global) {
    context_.error(expression.at, "this is not a variable, so nothing can be assigned to it");
    return false;
  }
  const Variable* variable = root.resolved->variable;
  const Global* global = root.resolved->global;
  if ((variable != nullptr && variable->is_constant) || (global != nullptr && global->kind == Global::Kind::Fixed)) {
    context_.error(expression.at, fmt::format("'{}' is CONSTANT and cannot be changed", root.name));
    return false;
  }
  if (global != nullptr && global->address.starts_with("%I")) {
    context_.error(expression.at,
                   fmt::format("{} is an input, which only the world outside changes; use %Q or %M", global->address));
    return false;
  }
  // Outputs of an instance belong to its function block.
  for (const Expression* at = &expression; at != &root; at = &at->operands[0]) {
    const Type* base = at->operands[0].type;
    const bool of_block = at->kind == Expression::Kind::Member && base != nullptr && base->kind == Type::Kind::Block;
    if (of_block && at->resolved->is_output) {
      context_.error(expression.at, fmt::format("'{}' is an output of {}, only the block itself writes it", at->name,
                                                to_string(*base)));
      return false;
    }
  }
  return true;
}

void ExpressionChecker::note_call(const Expression& expression) {
  const Resolved* root = root_of(expression).resolved.get();
  if (context_.pou != nullptr && root != nullptr && root->variable != nullptr) {
    context_.pou->find(upper(root->variable->name))->called = true;
  }
}

void ExpressionChecker::note_write(const Expression& expression) {
  if (context_.pou == nullptr) {
    return;
  }
  const Resolved& root = *root_of(expression).resolved;
  for (const auto& [variable, at] : context_.loop_variables) {
    if (variable == root.variable || variable == root.global) {
      context_.error(expression.at, fmt::format("this is the variable of the FOR at {}, which must not be changed "
                                                "inside; leave the loop with EXIT, or use WHILE",
                                                to_string(at)));
    }
  }
  if (root.variable != nullptr) {
    context_.pou->find(upper(root.variable->name))->written = true;
  }
  if (root.meaning == Meaning::FunctionResult) {
    context_.pou->result_assigned = true;
  } else if (root.global != nullptr) {
    bool fixed = false;
    context_.pou->globals[root.global].writes.insert(path_of(expression, fixed));
  }
}

}  // namespace indurop::plc
