// SPDX-License-Identifier: Apache-2.0
// C++ computes operands and arguments in any order, the standard from left to right. Where a call may change what
// another operand sees, their values are taken one after the other.

#pragma once

#include <string>
#include <vector>

#include "plc/check/program.h"

namespace indurop::plc {

class OperandOrder {
 public:
  // All that is computed for one operation or call.
  explicit OperandOrder(const std::vector<const ast::Expression*>& operands);

  // `text` is the value of the operand; what stands for it. Call it from left to right.
  [[nodiscard]] std::string take(const ast::Expression& operand, const std::string& text);
  // `text` is the operation, made of what take() returned.
  [[nodiscard]] std::string close(const std::string& text) const;

 private:
  bool matters_;
  int taken_ = 0;
  std::string before_;
};

}  // namespace indurop::plc
