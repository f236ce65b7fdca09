// SPDX-License-Identifier: Apache-2.0
// Statements that start an instance, or all of an array: first the instances inside it, then its FB_Init.

#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/check/context.h"

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

  // Returns the function block whose instances must be started in variables of the type. Null if there is none.
  const Pou* started(const Type* type);
  // Returns whether its variables, including inherited ones, contain something that must be started.
  bool needs_start(const Pou& pou);
  // Returns whether the variable lives as long as the instance that contains it.
  [[nodiscard]] static bool lasts(const Variable& one);

  // Adds the statements for an array: loops whose variables `method` gets; `method` null: it can have no further
  // variables, so one statement per instance.
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
