// SPDX-License-Identifier: Apache-2.0
// An expression in a job: numbers, variables of the job and shared variables, in the order of a stack machine
// (postfix). ON is 1, OFF is 0; every value except 0 counts as true.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace indurop::robot {

class Signals;

enum class FormulaOp : std::uint8_t {
  Number,
  Variable,  // index: variable of the job
  Signal,    // index: shared variable
  Negate,
  Not,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  And,
  Or
};

struct FormulaPart {
  FormulaOp op = FormulaOp::Number;
  int index = -1;
  double value = 0;
};

class Formula {
 public:
  static constexpr int kMaxOperands = 16;        // operands on the stack
  static constexpr std::size_t kMaxParts = 100;  // parts

  void push(const FormulaPart& part);
  // Returns false if the expression is deeper or longer than can be evaluated.
  [[nodiscard]] bool fits() const noexcept { return deepest_ <= kMaxOperands && parts_.size() <= kMaxParts; }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size(); }
  // Returns whether it reads variables of the job.
  [[nodiscard]] bool reads_variables() const noexcept { return reads_variables_; }
  // Returns whether it reads shared variables.
  [[nodiscard]] bool reads_signals() const noexcept { return reads_signals_; }
  // Evaluates the expression. NaN if any part of it has no finite value. Real-time safe.
  [[nodiscard]] double value(std::span<const double> variables, Signals& signals) const noexcept;

  static Formula number(double value);
  static Formula variable(int index);
  // Joins two expressions by an operation.
  static Formula joined(Formula left, const Formula& right, FormulaOp op);

 private:
  std::vector<FormulaPart> parts_;
  int depth_ = 0;
  int deepest_ = 0;
  bool reads_variables_ = false;
  bool reads_signals_ = false;
};

}  // namespace indurop::robot
