// SPDX-License-Identifier: Apache-2.0
// Checks conversions between enumerations and numbers.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class EnumerationCasts {
 public:
  EnumerationCasts(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  // Turns the expression into its conversion: an enumeration is a number, and a number one of an enumeration.
  void cast(ast::Expression& expression, const Type& to);
  bool convert_enumeration(ast::Expression& expression, const Type& to);
  bool enumeration_call(ast::Expression& call, const Type*& type);

 private:
  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
