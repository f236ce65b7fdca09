// SPDX-License-Identifier: Apache-2.0
// Statements that start an instance, or all of an array: what is in it, then its FB_Init.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "plc/check/context.h"

namespace indurop::plc {

namespace start {
[[nodiscard]] ast::Expression super_of(const Place& at);
[[nodiscard]] ast::Statement run(ast::Expression object, std::string_view method, std::vector<ast::Argument> arguments);
[[nodiscard]] std::vector<const Variable*> inputs_of(const Pou& method);
[[nodiscard]] const ast::TypeSpec& innermost(const ast::TypeSpec& spec);
}  // namespace start

class StartStatements {
 public:
  explicit StartStatements(Context& context) : context_(context) {}

  // The function block whose instances have to be started in variables of the type. Null: nothing.
  const Pou* started(const Type* type);
  // Whether something in its variables has to be, those it inherits included.
  bool needs_start(const Pou& pou);
  // As long as what it is a variable of.
  [[nodiscard]] static bool lasts(const Variable& one);

  // Of an array: loops, whose variables `method` gets; null: it can have no more, so one instance after the other.
  void instances(ast::Pou* method, const Variable& one, ast::Body& to);
  void elements(ast::Pou* method, const std::vector<ast::StartArguments>& starts, const Type& type,
                ast::Expression object, ast::Body& to);

 private:
  bool needs(const Pou& pou);
  void loops(ast::Pou& method, const std::vector<ast::StartArguments>& starts, const Type& type,
             const ast::Expression& object, ast::Body& to);
  void each(const std::vector<ast::StartArguments>& starts, const Type& type, const ast::Expression& element,
            ast::Body& to);
  void listed(const std::vector<ast::StartArguments>& starts, const Type& type, const ast::Expression& object,
              ast::Body& to);
  void instance(const ast::StartArguments& given, const Type& type, ast::Expression object, ast::Body& to);

  Context& context_;
  std::map<const Pou*, bool> needs_;
  std::map<const Pou*, bool> needs_start_;
};

}  // namespace indurop::plc
