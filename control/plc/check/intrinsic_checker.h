// SPDX-License-Identifier: Apache-2.0
// Checks ADR, REF, SIZEOF, __ISVALIDREF, LOWER_BOUND and UPPER_BOUND.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class IntrinsicChecker {
 public:
  IntrinsicChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  bool address_call(ast::Expression& call, const Type*& type);

 private:
  const Type* bound_of(ast::Expression& call, bool lower);
  const Type* size_of(ast::Expression& call, ast::Expression& of);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
