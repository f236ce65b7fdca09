// SPDX-License-Identifier: Apache-2.0
// Checks calls: which function is called, which argument belongs to which parameter, and the types that follow from
// that.

#pragma once

#include <string>
#include <vector>

#include "control/plc/check/argument_checker.h"
#include "control/plc/check/context.h"
#include "control/plc/check/intrinsic_checker.h"
#include "control/plc/check/overload.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {

class CallChecker {
 public:
  CallChecker(ExpressionChecker& expressions, Context& context)
      : expressions_(expressions),
        context_(context),
        arguments_(expressions, context),
        intrinsics_(expressions, context),
        overloads_(expressions, context) {}

  // Checks a call with a result. EN and ENO are allowed if it is the whole right side of an assignment.
  const Type* function(ast::Expression& call, const Type* wanted, bool whole_side);
  // Checks a call as a statement: a function, or an instance of a function block.
  void statement(ast::Expression& call);
  // Checks the arguments of a function or method; returns the type of the result.
  const Type* user_function(ast::Expression& call, const Pou& pou);
  // Resolves + - * / MOD ** to the library function of the same meaning.
  const Type* operation(ast::Expression& expression, const Type* wanted) {
    return overloads_.operation(expression, wanted);
  }

 private:
  // Replaces Standard.LEN by LEN, unless the program declares something named Standard.
  void leave_out_library(ast::Expression& callee) const;
  [[nodiscard]] std::vector<const LibraryFunction*> overloads_of(const std::string& name, const Type* wanted) const;
  void library_block(ast::Expression& call, const LibraryBlock& block);
  static std::vector<const Variable*> by_position(const ast::Expression& call, const Pou& pou);
  void no_function(const ast::Expression& call);
  void user_block(ast::Expression& call, const Pou& pou);
  void output_to(ast::Argument& argument, const Type& type);
  bool take_enable(ast::Expression& call, bool allowed);

  ExpressionChecker& expressions_;
  Context& context_;
  ArgumentChecker arguments_;
  IntrinsicChecker intrinsics_;
  OverloadResolver overloads_;
};

}  // namespace indurop::plc
