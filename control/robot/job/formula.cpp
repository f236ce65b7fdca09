// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/formula.h"

#include <indurop/robot/controller.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "control/robot/job/job_places.h"
#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

namespace {

bool is_operand(FormulaOp op) noexcept {
  return op < FormulaOp::Element;
}
bool takes_one(FormulaOp op) noexcept {
  return op >= FormulaOp::Element && op < FormulaOp::Add;
}

double computed(FormulaOp op, double value) noexcept {
  switch (op) {
    case FormulaOp::Negate:
      return -value;
    case FormulaOp::Not:
      return value == 0 ? 1 : 0;
    case FormulaOp::Abs:
      return std::abs(value);
    case FormulaOp::Sqrt:
      return std::sqrt(value);
    case FormulaOp::Sin:
      return std::sin(radians(value));
    case FormulaOp::Cos:
      return std::cos(radians(value));
    case FormulaOp::Tan:
      return std::tan(radians(value));
    case FormulaOp::Asin:
      return degrees(std::asin(value));
    case FormulaOp::Acos:
      return degrees(std::acos(value));
    case FormulaOp::Atan:
      return degrees(std::atan(value));
    case FormulaOp::Round:
      return std::round(value);
    case FormulaOp::Trunc:
      return std::trunc(value);
    default:
      return value;
  }
}

double computed(FormulaOp op, double left, double right) noexcept {
  switch (op) {
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
    case FormulaOp::Atan2:
      return degrees(std::atan2(left, right));
    case FormulaOp::Min:
      return std::min(left, right);
    case FormulaOp::Max:
      return std::max(left, right);
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
    default:
      return right;
  }
}

double element(const FormulaPart& array, double index, std::span<const double> variables) noexcept {
  const bool inside = index >= 0 && index < array.value && index == std::floor(index);
  return inside ? variables[static_cast<std::size_t>(array.index) + static_cast<std::size_t>(index)]
                : std::numeric_limits<double>::quiet_NaN();
}

const char* flaw_of(FormulaOp op) noexcept {
  switch (op) {
    case FormulaOp::Element:
      return "this has no value: an array has no such element; the first one is [0]";
    case FormulaOp::Divide:
    case FormulaOp::Modulo:
      return "this has no value: it divides by 0, or the result is too large; check the divisor before, with IF";
    case FormulaOp::Sqrt:
      return "this has no value: SQRT of a number below 0";
    case FormulaOp::Asin:
    case FormulaOp::Acos:
      return "this has no value: ASIN and ACOS take numbers from -1 to 1";
    case FormulaOp::Signal:
      return "this has no value: a shared variable is not a finite number";
    default:
      return "this has no value: a number in it is too large";
  }
}

}  // namespace

void Formula::push(const FormulaPart& part) {
  parts_.push_back(part);
  depth_ += is_operand(part.op) ? 1 : takes_one(part.op) ? 0 : -1;
  deepest_ = std::max(deepest_, depth_);
  reads_.add({part.op == FormulaOp::Variable || part.op == FormulaOp::Element, part.op == FormulaOp::Signal,
              part.op == FormulaOp::Time || part.op == FormulaOp::Found || part.op == FormulaOp::TipSpeed,
              part.op == FormulaOp::Coordinate});
}

double Formula::value(FormulaInput& in) const noexcept {
  std::array<double, kMaxOperands + 1> stack{};
  std::size_t top = 0;
  for (const FormulaPart& part : parts_) {
    double now = part.value;
    if (part.op == FormulaOp::Variable) {
      now = in.variables[static_cast<std::size_t>(part.index)];
    } else if (part.op == FormulaOp::Signal) {
      now = in.signals.read(static_cast<std::size_t>(part.index));
    } else if (part.op == FormulaOp::Time) {
      now = in.time;
    } else if (part.op == FormulaOp::TipSpeed) {
      now = 1000 * in.port->tip_speed();
    } else if (part.op == FormulaOp::Found) {
      now = in.places->found().known ? 1 : 0;
    } else if (part.op == FormulaOp::Coordinate) {
      now = in.places->coordinate(part.index, static_cast<Coordinate>(part.value), in);
    } else if (part.op == FormulaOp::Element) {
      now = element(part, stack[--top], in.variables);
    } else if (takes_one(part.op)) {
      now = computed(part.op, stack[--top]);
    } else if (part.op != FormulaOp::Number) {
      const double right = stack[--top];
      now = computed(part.op, stack[--top], right);
    }
    if (!std::isfinite(now)) {
      in.flaw = part.op == FormulaOp::Coordinate ? in.flaw : flaw_of(part.op);
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
  left.also_reads(right.reads_);
  left.push({op, -1, 0});
  return left;
}

}  // namespace indurop::robot
