// SPDX-License-Identifier: Apache-2.0
#include "control/plc/emit/index_check.h"

#include "control/plc/check/expression_checker.h"

namespace indurop::plc {

using ast::Expression;
using ast::Operator;

bool IndexCheck::is_needed(const Expression& index, Bounds bounds) const {
  if (index.kind == Expression::Kind::Name) {
    const auto loop = loops_.find(index.resolved->variable);
    return loop == loops_.end() || loop->second.low < bounds.low || loop->second.high > bounds.high;
  }
  const bool sum =
      index.kind == Expression::Kind::Binary && (index.op == Operator::Add || index.op == Operator::Subtract);
  const Constant* offset = sum ? constant_of(index.operands[1]) : nullptr;
  const auto number = offset != nullptr ? as_int64(*offset) : std::nullopt;
  constexpr std::int64_t kMaxOffset = 1'000'000'000;
  if (!number || *number > kMaxOffset || *number < -kMaxOffset) {
    return true;
  }
  const std::int64_t by = index.op == Operator::Add ? *number : -*number;
  return is_needed(index.operands[0], {bounds.low - by, bounds.high - by});
}

}  // namespace indurop::plc
