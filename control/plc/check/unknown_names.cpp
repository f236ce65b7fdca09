// SPDX-License-Identifier: Apache-2.0
// Names without a declaration of a variable or function: other meanings they may have, or the error message.

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "control/plc/check/expression_checker.h"
#include "control/plc/check/foreign_types.h"
#include "control/plc/check/global_table.h"
#include "control/plc/library/standard.h"
#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"

namespace indurop::plc {

using ast::Expression;

const Type* NameChecker::unknown(Expression& expression, const Type* wanted) {
  std::pair<std::string, std::string> both;
  if (const Type* found = bare_enum_value(expression, wanted, both)) {
    return found;
  }
  if (same_name(expression.name, "NULL")) {
    expression.resolved->constant = Integer{0};
    expression.resolved->untyped = true;
    return context_.elementary(Elementary::Int);
  }
  if (!both.first.empty()) {
    context_.error(expression.at, fmt::format("'{0}' is a value of {1} and of {2}, write {1}#{0} or {2}#{0}",
                                              expression.name, both.first, both.second));
    return nullptr;
  }
  if (Global* shared = only_foreign_global(context_, expression.name)) {
    return global(expression, *shared);
  }
  std::int64_t value = 0;
  if (const Type* type = foreign_enum_value(context_, expression.name, value)) {
    expression.resolved->constant = Integer{value};
    return type;
  }
  const auto pou = context_.program.pou_names.find(upper(expression.name));
  const bool is_function =
      pou != context_.program.pou_names.end() && pou->second->tree->kind == ast::Pou::Kind::Function;
  if (is_function || !find_functions(expression.name).empty()) {
    context_.error(expression.at, fmt::format("'{0}' is a function, call it: {0}(...)", expression.name));
    return nullptr;
  }
  if (pou != context_.program.pou_names.end() && pou->second->tree->kind == ast::Pou::Kind::Program) {
    context_.error(expression.at,
                   fmt::format("{} is a program, whose variables are its own; declare what others use as "
                               "VAR_GLOBAL, or say --dialect codesys",
                               pou->second->name));
    return nullptr;
  }
  complain_undeclared(context_, expression.at, expression.name);
  return nullptr;
}

void NameChecker::no_member(const Expression& expression, const Type& block) {
  std::vector<std::string> known;
  if (block.block != nullptr) {
    for (const LibraryParameter& one : block.block->outputs) {
      known.push_back(one.name);
    }
  } else if (block.pou != nullptr && find_method(*block.pou, expression.name) != nullptr) {
    context_.error(expression.at,
                   fmt::format("'{0}' is a method of {1}, call it: {0}(...)", expression.name, to_string(block)));
    return;
  } else if (block.pou != nullptr) {
    for (const Variable* one : all_variables(*block.pou)) {
      if (one->section == ast::Section::Output) {
        known.push_back(one->name);
      }
    }
  }
  context_.error(expression.at, fmt::format("{} has no input or output '{}'{}", to_string(block), expression.name,
                                            did_you_mean(context_, expression.name, known)));
}

void CallChecker::leave_out_library(Expression& callee) const {
  const std::string path = callee.kind == Expression::Kind::Member ? ast::path_of(callee) : "";
  const std::string name(name_in_standard(path));
  const std::string space = upper(path.substr(0, path.find('.')));
  const Program& program = context_.program;
  if (name.empty() || find_functions(name).empty() || program.global_names.contains(space) ||
      program.pou_names.contains(space) || program.type_names.contains(space) ||
      (context_.pou != nullptr && context_.pou->find(space) != nullptr)) {
    return;
  }
  callee = make::name(callee.at, name);
}

// Reports why the name is not a function.
void CallChecker::no_function(const Expression& call) {
  const Expression& callee = call.operands[0];
  const Variable* variable = context_.pou != nullptr ? context_.pou->find(upper(callee.name)) : nullptr;
  const auto pou = context_.program.pou_names.find(upper(callee.name));
  if (variable != nullptr && pou != context_.program.pou_names.end() &&
      pou->second->tree->kind == ast::Pou::Kind::Function) {
    context_.error(call.at, fmt::format("the variable '{}' of {} hides the function {}, rename one of them",
                                        variable->name, to_string(variable->declared->at), pou->second->name));
    return;
  }
  if (variable != nullptr) {
    context_.error(call.at,
                   fmt::format("'{}' is not a function; the call of a function block stands alone, its result is "
                               "in an output",
                               callee.name));
    return;
  }
  if (callee.name.starts_with('@')) {
    context_.error(call.at,
                   "this C code gives the time as a number, declare the variable it goes to as UDINT or ULINT");
    return;
  }
  if (same_name(callee.name, "__NEW") || same_name(callee.name, "__DELETE")) {
    context_.error(call.at, fmt::format("{} is not supported, because a program that runs in real time asks for no "
                                        "memory; declare the instance, or an array of them",
                                        callee.name));
    return;
  }
  if (const std::string why = why_left_out(context_.program.project, callee.name); !why.empty()) {
    context_.error(call.at, fmt::format("there is no function '{}'{}", callee.name, why));
    return;
  }
  if (const LibraryBlock* block = find_block(callee.name)) {
    context_.error(call.at, fmt::format("{0} is a function block: declare an instance of it, call that, and use its "
                                        "outputs: VAR x : {0}; END_VAR x(...);",
                                        block->name));
    return;
  }
  if (context_.diagnostics.full()) {  // further errors are only counted
    context_.error(call.at, fmt::format("there is no function '{}'", callee.name));
    return;
  }
  std::vector<std::string> known;
  for (const LibraryFunction& one : library_functions()) {
    known.push_back(one.name);
  }
  for (const Pou& one : context_.program.pous) {
    if (one.owner != nullptr && same_name(one.name, callee.name)) {
      context_.error(call.at, fmt::format("{} is a method of {}, call it of an instance: name.{}(...)", one.name,
                                          one.owner->name, one.name));
      return;
    }
    if (one.owner == nullptr) {
      known.push_back(one.name);
    }
  }
  const std::string hint = did_you_mean(context_, callee.name, known);
  context_.error(call.at, fmt::format("there is no function '{}'{}", callee.name,
                                      hint.empty() ? ", declare it as FUNCTION" : hint));
}

}  // namespace indurop::plc
