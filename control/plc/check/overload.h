// SPDX-License-Identifier: Apache-2.0
// Selects the overload of a library function by the types of its inputs, and resolves its generic types.

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "control/plc/check/context.h"
#include "control/plc/library/standard.h"

namespace indurop::plc {

class ExpressionChecker;

class OverloadResolver {
 public:
  OverloadResolver(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  const Type* library_function(ast::Expression& call, std::vector<const LibraryFunction*> overloads,
                               const Type* wanted);
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

  std::optional<Inputs> positions(ast::Expression& call, const LibraryFunction& first);
  const Type* widest_computed(const Inputs& inputs, const LibraryFunction& function, Generic generic);
  bool input_values(const Inputs& inputs, const std::vector<const LibraryFunction*>& overloads, const Type* wanted);
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
