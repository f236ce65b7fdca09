// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/operand_order.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/check/expression_checker.h"

namespace indurop::plc {
namespace {

using ast::Expression;

// Returns whether a value of the type refers to other variables.
bool leads_elsewhere(const Type& type) noexcept {
  return type.kind == Type::Kind::Pointer || type.kind == Type::Kind::Interface ||
         (type.kind == Type::Kind::Array && leads_elsewhere(*type.element)) ||
         std::any_of(type.fields.begin(), type.fields.end(),
                     [](const Field& field) { return leads_elsewhere(*field.type); });
}

// Returns true for a function that changes only its result.
bool is_pure(const Pou& pou) {
  return pou.tree->kind == ast::Pou::Kind::Function && !pou.calls_blocks &&
         std::none_of(pou.variables.begin(), pou.variables.end(),
                      [](const Variable& one) {
                        return one.section == ast::Section::InOut || one.declared->is_static || one.type == nullptr ||
                               leads_elsewhere(*one.type);
                      }) &&
         std::all_of(pou.globals.begin(), pou.globals.end(),
                     [](const auto& use) { return use.second.writes.empty(); }) &&
         std::all_of(pou.calls.begin(), pou.calls.end(), [](const Pou* one) { return is_pure(*one); });
}

bool has_effects(const Expression& expression) {
  const bool calls = expression.kind == Expression::Kind::Call && expression.resolved &&
                     expression.resolved->pou != nullptr && !is_pure(*expression.resolved->pou);
  return calls || std::any_of(expression.operands.begin(), expression.operands.end(), has_effects) ||
         std::any_of(expression.arguments.begin(), expression.arguments.end(),
                     [](const ast::Argument& one) { return one.output || (one.value && has_effects(*one.value)); });
}

}  // namespace

OperandOrder::OperandOrder(const std::vector<const Expression*>& operands)
    : matters_(std::any_of(operands.begin(), operands.end(), [](const Expression* one) { return has_effects(*one); }) &&
               std::count_if(operands.begin(), operands.end(),
                             [](const Expression* one) { return constant_of(*one) == nullptr; }) > 1) {}

std::string OperandOrder::take(const Expression& operand, const std::string& text) {
  if (!matters_ || constant_of(operand) != nullptr) {
    return text;
  }
  const std::string name = fmt::format("operand_{}", ++taken_);
  before_ += fmt::format("const auto {} = {}; ", name, text);
  return name;
}

std::string OperandOrder::close(const std::string& text) const {
  return before_.empty() ? text : fmt::format("[&] {{ {}return {}; }}()", before_, text);
}

}  // namespace indurop::plc
