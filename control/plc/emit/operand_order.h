// SPDX-License-Identifier: Apache-2.0
// C++ evaluates operands and arguments in any order, the standard from left to right. Where a call may change the value
// of another operand, the values are stored one after the other.

#pragma once

#include <string>
#include <vector>

#include "control/plc/check/program.h"

namespace indurop::plc {

class OperandOrder {
 public:
  // Takes all operands of one operation or call.
  explicit OperandOrder(const std::vector<const ast::Expression*>& operands);

  // `text` is the value of the operand; returns the text to use instead. Call it from left to right.
  [[nodiscard]] std::string take(const ast::Expression& operand, const std::string& text);
  // `text` is the operation, built from the results of take().
  [[nodiscard]] std::string close(const std::string& text) const;

 private:
  bool matters_;
  int taken_ = 0;
  std::string before_;
};

}  // namespace indurop::plc
