// SPDX-License-Identifier: Apache-2.0
// Checks what can be written and passed by reference, and records the writers.

#pragma once

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class WriteChecker {
 public:
  WriteChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  // Checks a variable that is written; returns its type, null after an error.
  const Type* target(ast::Expression& expression, bool instances = false);
  // Checks a variable that is passed by reference, read and written.
  const Type* reference(ast::Expression& expression);
  // Records that an instance is called, or passed by reference.
  void note_call(const ast::Expression& expression);
  void note_address(const ast::Expression& expression);

 private:
  bool writable(const ast::Expression& expression);
  void note_write(const ast::Expression& expression);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
