// SPDX-License-Identifier: Apache-2.0
// Checks initial values: one value, [..] of arrays, (..) of structures and instances of function blocks.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class InitialChecker {
 public:
  InitialChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  // Returns false after an error.
  bool initial(ast::Initial& initial, const Type& type);

 private:
  bool array_initial(ast::Initial& initial, const Type& type);
  bool struct_initial(ast::Initial& initial, const Type& type);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
