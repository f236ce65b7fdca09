// SPDX-License-Identifier: Apache-2.0
// Checks calls: which function is called, which argument belongs to which parameter, and the types that follow from
// that.

#pragma once

#include <vector>

#include "control/plc/check/expression_checker.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {

class CallChecker {
 public:
  explicit CallChecker(ExpressionChecker& expressions) : expressions_(expressions), context_(expressions.context_) {}

  // Checks a call with a result. EN and ENO are allowed if it is the whole right side of an assignment.
  // Replaces Standard.LEN by LEN, unless the program declares something named Standard.
  void leave_out_library(ast::Expression& callee) const;
  const Type* function(ast::Expression& call, const Type* wanted, bool whole_side);
  // Checks a call as a statement: a function, or an instance of a function block.
  void statement(ast::Expression& call);
  // Checks a call of a method or of an accessor of a property.
  const Type* method(ast::Expression& call, const Pou& pou);
  // Resolves + - * / MOD ** to the library function of the same meaning.
  const Type* operation(ast::Expression& expression, const Type* wanted);

 private:
  struct Choice {
    const LibraryFunction* function = nullptr;
    std::vector<const Type*> types;  // types of the inputs, by position
    const Type* result = nullptr;
    int cost = 0;
  };
  using Inputs = std::vector<ast::Expression*>;

  [[nodiscard]] std::vector<const LibraryFunction*> overloads_of(const std::string& name, const Type* wanted) const;
  std::optional<Inputs> positions(ast::Expression& call, const LibraryFunction& first);
  const Type* widest_beside(const Inputs& inputs, const LibraryFunction& function, Generic generic);
  bool input_values(const Inputs& inputs, const std::vector<const LibraryFunction*>& overloads, const Type* wanted);
  const Type* library_function(ast::Expression& call, std::vector<const LibraryFunction*> overloads,
                               const Type* wanted);
  bool address_call(ast::Expression& call, const Type*& type);
  const Type* bound_of(ast::Expression& call, bool lower);
  const Type* size_of(ast::Expression& call, ast::Expression& of);
  bool enumeration_call(ast::Expression& call, const Type*& type);
  const Pou* method_of(ast::Expression& callee, bool& said);
  const Type* user_function(ast::Expression& call, const Pou& pou);
  void library_block(ast::Expression& call, const LibraryBlock& block);
  void in_out(const ast::Expression& call, ast::Expression& given, const Variable& parameter);
  static std::vector<const Variable*> by_position(const ast::Expression& call, const Pou& pou);
  bool all_given(const ast::Expression& call, const Pou& pou);
  void no_function(const ast::Expression& call);
  const Pou* generic_function(ast::Expression& call, const ast::Pou& tree, const Type* wanted);
  void instance_input(ast::Expression& given, const Variable& parameter);
  bool may_run(const ast::Expression& callee);
  void user_block(ast::Expression& call, const Pou& pou);
  void output_to(ast::Argument& argument, const Type& type);
  bool take_enable(ast::Expression& call, bool allowed);

  const Type* choose(ast::Expression& at, const std::vector<const LibraryFunction*>& overloads, const Inputs& inputs,
                     const Type* wanted);
  std::optional<Choice> match(const LibraryFunction& function, const Inputs& inputs, const Type* wanted);
  const Type* group_type(const LibraryFunction& function, std::size_t member, const Inputs& inputs, const Type* wanted);
  const Type* join_untyped(Generic generic, const Type* group, const ast::Expression& input, const Type* wanted);
  std::optional<int> cost_of(const ast::Expression& input, const Type& type);
  void apply(ast::Expression& at, const Choice& choice, const Inputs& inputs);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
