// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/formula.h"

#include <indurop/robot/controller.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace indurop::robot {

namespace {

bool is_operand(FormulaOp op) noexcept {
  return op == FormulaOp::Number || op == FormulaOp::Variable || op == FormulaOp::Signal;
}
bool takes_one(FormulaOp op) noexcept {
  return op == FormulaOp::Negate || op == FormulaOp::Not;
}

double computed(FormulaOp op, double left, double right) noexcept {
  switch (op) {
    case FormulaOp::Negate:
      return -right;
    case FormulaOp::Not:
      return right == 0 ? 1 : 0;
    case FormulaOp::Add:
      return left + right;
    case FormulaOp::Subtract:
      return left - right;
    case FormulaOp::Multiply:
      return left * right;
    case FormulaOp::Divide:
      return left / right;
    case FormulaOp::Modulo:
      return std::fmod(left, right);
    case FormulaOp::Equal:
      return left == right ? 1 : 0;
    case FormulaOp::NotEqual:
      return left != right ? 1 : 0;
    case FormulaOp::Less:
      return left < right ? 1 : 0;
    case FormulaOp::LessEqual:
      return left <= right ? 1 : 0;
    case FormulaOp::Greater:
      return left > right ? 1 : 0;
    case FormulaOp::GreaterEqual:
      return left >= right ? 1 : 0;
    case FormulaOp::And:
      return left != 0 && right != 0 ? 1 : 0;
    case FormulaOp::Or:
      return left != 0 || right != 0 ? 1 : 0;
    case FormulaOp::Number:
    case FormulaOp::Variable:
    case FormulaOp::Signal:
      break;
  }
  return right;
}

}  // namespace

void Formula::push(const FormulaPart& part) {
  parts_.push_back(part);
  depth_ += is_operand(part.op) ? 1 : takes_one(part.op) ? 0 : -1;
  deepest_ = std::max(deepest_, depth_);
  reads_variables_ = reads_variables_ || part.op == FormulaOp::Variable;
  reads_signals_ = reads_signals_ || part.op == FormulaOp::Signal;
}

double Formula::value(std::span<const double> variables, Signals& signals) const noexcept {
  std::array<double, kMaxOperands + 1> stack{};
  std::size_t top = 0;
  for (const FormulaPart& part : parts_) {
    double now = part.value;
    if (part.op == FormulaOp::Variable) {
      now = variables[static_cast<std::size_t>(part.index)];
    } else if (part.op == FormulaOp::Signal) {
      now = signals.read(static_cast<std::size_t>(part.index));
    } else if (part.op != FormulaOp::Number) {
      const double right = stack[--top];
      now = computed(part.op, takes_one(part.op) ? 0 : stack[--top], right);
    }
    if (!std::isfinite(now)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    stack[top++] = now;
  }
  return top > 0 ? stack[top - 1] : 0;
}

Formula Formula::number(double value) {
  Formula formula;
  formula.push({FormulaOp::Number, -1, value});
  return formula;
}

Formula Formula::variable(int index) {
  Formula formula;
  formula.push({FormulaOp::Variable, index, 0});
  return formula;
}

Formula Formula::joined(Formula left, const Formula& right, FormulaOp op) {
  for (const FormulaPart& part : right.parts_) {
    left.push(part);
  }
  left.push({op, -1, 0});
  return left;
}

}  // namespace indurop::robot
