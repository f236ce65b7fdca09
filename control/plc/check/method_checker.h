// SPDX-License-Identifier: Apache-2.0
// Checks calls of methods, properties, THIS and SUPER.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class MethodChecker {
 public:
  MethodChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  const Type* this_or_super(ast::Expression& expression);
  bool variable_of_this(ast::Expression& expression);
  bool can_see(Variable& variable, const Place& at);
  const Pou* accessor(const Pou& pou, const ast::Expression& expression, ast::Accessor which);
  const Type* read_property(ast::Expression& expression, const Pou& getter);
  // Turns x.Speed := value, where Speed is a PROPERTY, into a call. Returns false and changes nothing if it is not one.
  bool write_property(ast::Statement& statement);
  // Returns whether the call is one of an action of another instance.
  [[nodiscard]] bool is_action(ast::Expression& callee);
  const Pou* method_of(ast::Expression& callee, bool& said);
  // Checks a call of a method or of an accessor of a property.
  const Type* method(ast::Expression& call, const Pou& pou);

 private:
  bool may_call(const Pou& method, const Place& at);
  const Type* object(ast::Expression& expression);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
