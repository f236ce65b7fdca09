// SPDX-License-Identifier: Apache-2.0
// Checks operators: the common type of both sides, and the result if it is constant.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class OperationChecker {
 public:
  OperationChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  const Type* unary(ast::Expression& expression, const Type* wanted);
  const Type* binary(ast::Expression& expression, const Type* wanted);
  void warn_about_exactness(const Place& at, const Type& type, const ast::Expression& a, const ast::Expression& b);

 private:
  void count_enumerations(ast::Expression& expression);
  [[nodiscard]] bool is_no_variable(const ast::Expression& expression) const;
  bool sides(ast::Expression& expression, const Type* wanted);
  const Type* comparison(ast::Expression& expression);
  const Type* logic(ast::Expression& expression);
  const Type* arithmetic(ast::Expression& expression, const Type* wanted);
  void fold(ast::Expression& expression, const Type& operand);
  bool meet(ast::Expression& a, ast::Expression& b);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
