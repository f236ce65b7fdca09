// SPDX-License-Identifier: Apache-2.0
// Checks POINTER TO, REF_TO, REFERENCE TO and interfaces: what they lead to, and arithmetic with them.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class PointerChecker {
 public:
  PointerChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  const Type* deref(ast::Expression& expression);
  const Type* follow(ast::Expression& expression, const Type& reference);
  // Checks a REFERENCE TO without following it: the target of REF=.
  const Type* reference_itself(ast::Expression& expression);
  // Turns the expression into the address of its variable.
  bool bind(ast::Expression& expression, const Type& to);
  bool assigned_pointer(ast::Expression& expression, const Type& to);
  bool assigned_interface(ast::Expression& expression, const Type& to);
  const Type* pointer_index(ast::Expression& expression, const Type& pointer);
  const Type* pointer_operation(ast::Expression& expression);
  const Type* pointer_comparison(ast::Expression& expression);
  // Returns whether the expression is in an ARRAY[*], and reports that as an error.
  bool is_open(const ast::Expression& expression);

 private:
  void complain_of_range(const Place& at, const Type& type, const Type& to);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
