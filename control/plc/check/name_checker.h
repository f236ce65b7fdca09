// SPDX-License-Identifier: Apache-2.0
// Resolves names: variables, members, values of enumerations, shared variables, addresses.

#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "control/plc/check/context.h"

namespace indurop::plc {

class ExpressionChecker;

class NameChecker {
 public:
  NameChecker(ExpressionChecker& expressions, Context& context) : expressions_(expressions), context_(context) {}

  const Type* name(ast::Expression& expression, const Type* wanted);
  const Type* direct(ast::Expression& expression);
  const Type* member(ast::Expression& expression);
  // Returns the instance through which other POUs use a program by its name; null if there is no such program, or the
  // dialect does not support that.
  Global* program_named(std::string_view name);

 private:
  const Type* enum_value(ast::Expression& expression, const Type& type, std::string_view item);
  const Type* bare_enum_value(ast::Expression& expression, const Type* wanted,
                              std::pair<std::string, std::string>& both);
  const Type* global(ast::Expression& expression, Global& global);
  // Returns the type of the pin; null if the block has none of that name.
  const Type* library_pin(ast::Expression& expression, const LibraryBlock& block);
  const Type* block_member(ast::Expression& expression, const Type& block);
  const Type* namespace_member(ast::Expression& expression, const std::string& path);
  const Type* named_bit(ast::Expression& expression, const Type& base);
  const Type* unknown(ast::Expression& expression, const Type* wanted);
  // Reports that the instance has no such member and suggests one.
  void no_member(const ast::Expression& expression, const Type& block);

  ExpressionChecker& expressions_;
  Context& context_;
};

}  // namespace indurop::plc
