// SPDX-License-Identifier: Apache-2.0
// What a job computes: numbers, its own variables and shared ones, in the order in which a stack takes them. ON is 1,
// OFF is 0; everything but 0 counts as true.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace indurop::robot {

class Signals;

enum class FormulaOp : std::uint8_t {
  Number,
  Variable,  // index: of the job
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
  static constexpr int kDeepest = 16;        // numbers that wait for their operation
  static constexpr std::size_t kMost = 100;  // parts

  void push(const FormulaPart& part);
  // False: deeper or longer than can be computed.
  [[nodiscard]] bool fits() const noexcept { return deepest_ <= kDeepest && parts_.size() <= kMost; }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size(); }
  // It looks at variables of the job.
  [[nodiscard]] bool looks_in() const noexcept { return looks_in_; }
  // It looks at shared variables.
  [[nodiscard]] bool looks_out() const noexcept { return looks_out_; }
  // NaN if any part of it has no finite value. Real-time safe.
  [[nodiscard]] double value(std::span<const double> variables, Signals& signals) const noexcept;

  static Formula number(double value);
  static Formula variable(int index);
  // Both, and what is done with them.
  static Formula joined(Formula left, const Formula& right, FormulaOp op);

 private:
  std::vector<FormulaPart> parts_;
  int depth_ = 0;
  int deepest_ = 0;
  bool looks_in_ = false;
  bool looks_out_ = false;
};

}  // namespace indurop::robot
