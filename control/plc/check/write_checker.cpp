// SPDX-License-Identifier: Apache-2.0
#include "control/plc/check/write_checker.h"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "control/plc/check/designator.h"
#include "control/plc/check/expression_checker.h"
#include "control/plc/check/instance_contents.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

// Returns ".a.b" up to the first index; `fixed` is false if there is one.
std::string path_of(const Expression& expression, bool& fixed) {
  if (expression.resolved && expression.resolved->meaning != Meaning::Value) {
    fixed = true;
    return "";
  }
  std::string path = path_of(expression.operands[0], fixed);
  fixed = fixed && expression.kind == Expression::Kind::Member;
  return fixed ? path + "." + expression.name : path;
}

// Marks the variables of the instances in a value of the type as aliased.
void mark_aliased(const Type& type, std::set<const Pou*>& marked) {
  if (type.element != nullptr && type.kind == Type::Kind::Array) {
    mark_aliased(*type.element, marked);
  }
  for (const Pou* pou = type.kind == Type::Kind::Block ? type.pou : nullptr; pou != nullptr; pou = pou->base) {
    if (!marked.insert(pou).second) {
      return;
    }
    for (const auto& [name, variable] : pou->names) {
      variable->aliased = true;
      if (variable->type != nullptr) {
        mark_aliased(*variable->type, marked);
      }
    }
  }
}

}  // namespace

const Type* WriteChecker::target(Expression& expression, bool instances) {
  const ExpressionChecker::Mode mode{expression.kind == Expression::Kind::Bit, expressions_.mode().following};
  const Type* type = expressions_.with(
      mode, [&] { return instances ? expressions_.value_or_instance(expression) : expressions_.value(expression); });
  if (type == nullptr || !writable(expression)) {
    return nullptr;
  }
  note_write(expression);
  return type;
}

const Type* WriteChecker::reference(Expression& expression) {
  const Type* type = expressions_.typed(expression, nullptr);
  if (type == nullptr || !writable(expression)) {
    return nullptr;
  }
  if (expression.kind == Expression::Kind::Bit) {
    context_.error(expression.at, "a part of a variable cannot be passed by reference, copy it to a variable first");
    return nullptr;
  }
  note_call(expression);
  note_write(expression);
  return type;
}

bool WriteChecker::writable(const Expression& expression) {
  if (is_designator(expression) && through_pointer(expression) != nullptr) {
    return true;
  }
  const Expression& root = root_of(expression);
  const Meaning meaning = !is_designator(expression) ? Meaning::Value
                          : root.resolved            ? root.resolved->meaning
                                                     : Meaning::Value;
  if (meaning == Meaning::FunctionResult || meaning == Meaning::This || meaning == Meaning::Super) {
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
  const std::string address = global != nullptr                                ? global->address
                              : variable != nullptr && is_placeless(*variable) ? to_string(*variable->declared->address)
                                                                               : "";
  if (address.starts_with("%I")) {
    context_.error(expression.at,
                   fmt::format("{} is an input, which only the world outside changes; use %Q or %M", address));
    return false;
  }
  // Outputs of an instance are written by its function block only.
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

void WriteChecker::note_call(const Expression& expression) {
  const Resolved* root = root_of(expression).resolved.get();
  if (context_.pou != nullptr && root != nullptr && root->variable != nullptr) {
    Variable& variable = *context_.pou->find(upper(root->variable->name));
    variable.called = true;
    variable.aliased = true;
  }
}

// A pointer can be moved anywhere in the variable to which it points.
void WriteChecker::note_address(const Expression& expression) {
  if (through_pointer(expression) != nullptr) {
    return;
  }
  const Expression& root = root_of(expression);
  if (root.type != nullptr) {
    std::set<const Pou*> marked;
    mark_aliased(*root.type, marked);
  }
  const Global* global = root.resolved->global;
  if (global != nullptr && global->type->kind == Type::Kind::Struct) {
    for (const Field& field : global->type->fields) {
      context_.pou->globals[global].writes.insert("." + field.member());
    }
  }
}

void WriteChecker::note_write(const Expression& expression) {
  if (context_.pou == nullptr || through_pointer(expression) != nullptr) {
    return;  // recorded where its address was taken
  }
  const Resolved& root = *root_of(expression).resolved;
  for (const auto& [variable, at] : context_.loop_variables) {
    const bool changed = variable == root.variable || variable == root.global;
    if (changed && context_.codesys()) {
      context_.warning(expression.at,
                       fmt::format("this changes the variable of the FOR at {}, and with it how often the "
                                   "loop runs",
                                   to_string(at)));
    } else if (changed) {
      context_.error(expression.at, fmt::format("this is the variable of the FOR at {}, which must not be changed "
                                                "inside; leave the loop with EXIT, or use WHILE",
                                                to_string(at)));
    }
  }
  if (root.variable != nullptr) {
    Variable& variable = *context_.pou->find(upper(root.variable->name));
    const ast::Pou::Kind kind = context_.pou->tree->kind;
    const bool keeps = kind == ast::Pou::Kind::FunctionBlock || kind == ast::Pou::Kind::Program;
    if (keeps && variable.section == ast::Section::Input && variable.owner == context_.pou && !variable.written) {
      context_.warning(expression.at,
                       fmt::format("'{}' is an input, which the caller gives; what is written here stays "
                                   "until then only",
                                   variable.name));
    }
    variable.written = true;
  }
  if (root.meaning == Meaning::FunctionResult) {
    context_.pou->result_assigned = true;
  } else if (root.global != nullptr) {
    bool fixed = false;
    context_.pou->globals[root.global].writes.insert(path_of(expression, fixed));
  }
}

}  // namespace indurop::plc
