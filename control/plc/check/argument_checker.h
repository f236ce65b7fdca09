// SPDX-License-Identifier: Apache-2.0
// Checks arguments passed as VAR_IN_OUT, as an instance, and to inputs of types such as ANY_NUM.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class ArgumentChecker {
 public:
  ArgumentChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  void in_out(const ast::Expression& call, ast::Expression& given, const Variable& parameter);
  void instance_input(ast::Expression& given, const Variable& parameter);
  bool all_given(const ast::Expression& call, const Pou& pou);
  bool may_run(const ast::Expression& callee);
  const Pou* generic_function(ast::Expression& call, const ast::Pou& tree, const Type* wanted);

 private:
  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
