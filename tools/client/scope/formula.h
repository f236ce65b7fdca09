// SPDX-License-Identifier: Apache-2.0
// Small expressions over variables, for a channel of a scope or its trigger: "speed > 100 and not stop", "abs(target -
// actual)". Values are doubles; true is 1. Does not access variables: the caller finds them by name.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/problem.h"
#include "core/schema/schema.h"

namespace indurop::tools {

// The input that a name refers to.
struct Operand {
  std::size_t index = 0;  // among the inputs of value()
  std::string unit;
  const std::vector<schema::Enumerator>* enumerators = nullptr;  // for an enumeration; must live while parse() runs
};
using FindOperand = std::function<Result<Operand, base::Problem>(std::string_view name)>;

class Formula {
 public:
  // Errors: what is wrong and where (in the text); two incompatible units; errors of `find`.
  static Result<Formula, base::Problem> parse(std::string_view text, const FindOperand& find);
  // A formula that is this input only.
  static Formula of(const Operand& operand);

  // Returns NaN if a value that is needed is NaN; a comparison with NaN is false.
  [[nodiscard]] double value(std::span<const double> inputs) const;
  [[nodiscard]] const std::string& unit() const noexcept { return unit_; }

 private:
  friend class FormulaParser;
  enum class Op : std::uint8_t {
    Number,
    Input,
    Negate,
    Not,
    Abs,
    Sqrt,
    Plus,
    Minus,
    Times,
    Over,
    Rest,
    Less,
    LessEqual,
    More,
    MoreEqual,
    Equal,
    Unequal,
    And,
    Or,
    Min,
    Max
  };
  struct Step {
    Op op{};
    double number = 0;
    std::size_t input = 0;
  };
  static double two(Op op, double a, double b);

  std::vector<Step> steps_;  // in postfix order, evaluated on a stack
  std::string unit_;
};

}  // namespace indurop::tools
