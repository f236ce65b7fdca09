// SPDX-License-Identifier: Apache-2.0
// An expression in a job: numbers, variables of the job and shared variables, in the order of a stack machine
// (postfix). ON is 1, OFF is 0; every value except 0 counts as true. Angles are in degrees.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace indurop::robot {

class JobPlaces;
class MotionPort;
class Signals;

enum class FormulaOp : std::uint8_t {
  Number,
  Variable,    // index: variable of the job
  Signal,      // index: shared variable
  TipSpeed,    // mm/s of the tip
  Time,        // s that the job has run
  Found,       // 1 if the last UNTIL has ended its motion
  Coordinate,  // of a place; index: place formula; value: Coordinate
  // Functions of one value.
  Element,  // of an array; index: its first variable; value: its size
  Negate,
  Not,
  Abs,
  Sqrt,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Round,
  Trunc,
  // Functions of two values.
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Atan2,
  Min,
  Max,
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

enum class Coordinate : std::uint8_t { X, Y, Z, Roll, Pitch, Yaw, Distance };

// What expressions and places depend on.
struct Reads {
  bool variables = false;  // of the job
  bool signals = false;    // shared variables
  bool robot = false;      // where the robot is, what it found, or the time
  bool places = false;     // points and frames
  void add(const Reads& more) noexcept {
    variables = variables || more.variables;
    signals = signals || more.signals;
    robot = robot || more.robot;
    places = places || more.places;
  }
  // Returns whether the value may change while the robot moves.
  [[nodiscard]] bool world() const noexcept { return signals || robot; }
};

// What an expression reads while it is evaluated.
struct FormulaInput {
  std::span<const double> variables;
  Signals& signals;
  double time = 0;                    // s that the job has run
  const JobPlaces* places = nullptr;  // null: it contains no places
  const MotionPort* port = nullptr;
  const char* flaw = nullptr;  // is set if the expression has no value: why, and what to do
};

class Formula {
 public:
  static constexpr int kMaxOperands = 16;        // operands on the stack
  static constexpr std::size_t kMaxParts = 100;  // parts

  void push(const FormulaPart& part);
  // Returns false if the expression is deeper or longer than can be evaluated.
  [[nodiscard]] bool fits() const noexcept { return deepest_ <= kMaxOperands && parts_.size() <= kMaxParts; }
  [[nodiscard]] std::size_t size() const noexcept { return parts_.size(); }
  // The column at which it begins in its line; 0: it was not written by the user.
  [[nodiscard]] unsigned column() const noexcept { return column_; }
  void begin_at(std::size_t column) noexcept { column_ = static_cast<unsigned>(column); }
  [[nodiscard]] const Reads& reads() const noexcept { return reads_; }
  // Adds what a place in it depends on.
  void also_reads(const Reads& more) noexcept { reads_.add(more); }
  // Evaluates the expression. NaN if any part of it has no finite value; `in` then says why. Real-time safe.
  [[nodiscard]] double value(FormulaInput& in) const noexcept;

  static Formula number(double value);
  static Formula variable(int index);
  // Joins two expressions by an operation.
  static Formula joined(Formula left, const Formula& right, FormulaOp op);

 private:
  std::vector<FormulaPart> parts_;
  int depth_ = 0;
  int deepest_ = 0;
  unsigned column_ = 0;
  Reads reads_;
};

}  // namespace indurop::robot
