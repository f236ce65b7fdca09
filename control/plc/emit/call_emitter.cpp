// SPDX-License-Identifier: Apache-2.0
// Emits calls of functions and methods.

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "control/plc/emit/expression_emitter.h"
#include "control/plc/emit/object_emitter.h"
#include "control/plc/emit/operand_order.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using Meaning = Resolved::Meaning;

// Returns the value of an omitted input.
std::string default_value(const Type& type, const ast::Initial* initial) {
  const std::string value = cpp_initial(type, initial);
  return value == "{}" ? cpp_type(type) + value : fmt::format("{}({})", cpp_type(type), value);
}

// Returns the arguments passed by value, from left to right.
std::vector<const Resolved::Actual*> inputs_of(const Expression& call) {
  std::vector<const Resolved::Actual*> inputs;
  for (const Resolved::Actual& one : call.resolved->actuals) {
    if (one.parameter->section == ast::Section::Input && one.argument != nullptr && one.argument->value) {
      inputs.push_back(&one);
    }
  }
  std::sort(inputs.begin(), inputs.end(), [](const auto* a, const auto* b) { return a->argument < b->argument; });
  return inputs;
}

}  // namespace

std::string ExpressionEmitter::library_call(const Expression& expression, const Type* text) const {
  const Resolved& resolved = *expression.resolved;
  std::string arguments = resolved.function->faults ? place(expression.at) : "";
  const auto input = [&](std::size_t i) -> const Expression& {
    const Resolved::Actual& one = resolved.actuals[i];
    return one.argument != nullptr ? *one.argument->value : expression.operands[i];
  };
  std::vector<const Expression*> inputs;
  for (std::size_t i = 0; i < resolved.actuals.size(); ++i) {
    inputs.push_back(&input(i));
  }
  OperandOrder order(inputs);
  for (std::size_t i = 0; i < resolved.actuals.size(); ++i) {
    arguments +=
        (arguments.empty() ? "" : ", ") + order.take(input(i), value(input(i), *resolved.actuals[i].type, true));
  }
  const std::string as = text != nullptr ? fmt::format("_as<{}>", cpp_type(*text)) : "";
  return order.close(fmt::format("{}{}({})", resolved.function->cpp, as, arguments));
}

// Returns the callee: a function of the user, or a method of an instance.
std::string ExpressionEmitter::callee(const Expression& call) const {
  const Pou& pou = *call.resolved->pou;
  if (pou.owner == nullptr) {
    return "plc::" + cpp_name(std::string_view(pou.name));
  }
  const Expression& called = call.operands[0];
  if (called.kind == Expression::Kind::Name) {
    return "this->" + method_name(pou);
  }
  const Expression& instance = called.operands[0];
  if (call.resolved->by_super) {
    return cpp_type(*instance.type) + "::" + method_name(pou);
  }
  return (instance.type->kind == Type::Kind::Interface
              ? fmt::format("iec::called({}, {})", place(called.at), raw(instance))
              : raw(instance)) +
         "." + method_name(pou);
}

std::string ExpressionEmitter::run(const Expression& callee, const std::string& instance) const {
  const Expression& base = callee.kind == Expression::Kind::Deref ? callee.operands[0] : callee;
  const bool super = base.resolved && base.resolved->meaning == Meaning::Super;
  return super ? cpp_type(*callee.type) + "::operator()" : instance;
}

std::string ExpressionEmitter::slice(const Expression& expression, const Type& to) const {
  if (expression.type->open) {
    return raw(expression);
  }
  std::string bounds;
  for (const Bounds& one : expression.type->dimensions) {
    bounds += fmt::format("{}{{{}, {}}}", bounds.empty() ? "" : ", ", one.low, one.high);
  }
  return fmt::format("{}({}, {{{{{}}}}})", cpp_type(to), raw(expression), bounds);
}

std::string ExpressionEmitter::user_call(const Expression& expression) const {
  std::string arguments;
  std::string before;
  std::string after;
  const std::vector<const Resolved::Actual*> inputs = inputs_of(expression);
  std::vector<const Expression*> operands;
  for (const Resolved::Actual* one : inputs) {
    operands.push_back(&*one->argument->value);
  }
  OperandOrder order(operands);
  std::map<const Resolved::Actual*, std::string> taken;
  for (const Resolved::Actual* one : inputs) {
    taken[one] = order.take(*one->argument->value, value(*one->argument->value, *one->type));
  }
  for (const Resolved::Actual& one : expression.resolved->actuals) {
    const bool given = one.argument != nullptr && one.argument->value;
    std::string text;
    if (one.parameter->section == ast::Section::Input) {
      const auto& initial = one.parameter->declared->initial;
      text = given ? taken[&one] : default_value(*one.type, initial ? &*initial : nullptr);
    } else if (one.parameter->section == ast::Section::InOut && given) {
      text = one.type->open ? slice(*one.argument->value, *one.type) : raw(*one.argument->value);
    } else if (!given) {
      text = fmt::format("iec::scratch<{}>()", cpp_type(*one.type));
    } else {
      const std::string local = fmt::format("out_{}", one.parameter->name);
      before += fmt::format("{} {}{{}}; ", cpp_type(*one.type), local);
      after += assign_output(*one.argument, local, *one.type) + "; ";
      text = local;
    }
    arguments += (arguments.empty() ? "" : ", ") + text;
  }
  const std::string call = fmt::format("{}({})", callee(expression), arguments);
  if (before.empty()) {
    return order.close(call);
  }
  if (expression.resolved->pou->result == nullptr) {
    return order.close(fmt::format("[&] {{ {}{}; {}}}()", before, call, after));
  }
  return order.close(fmt::format("[&] {{ {}auto result = {}; {}return result; }}()", before, call, after));
}

}  // namespace indurop::plc
