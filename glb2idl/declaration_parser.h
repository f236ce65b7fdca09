// SPDX-License-Identifier: Apache-2.0
// Parses declarations: types, variables, typed constants, shared functions; and recovers after errors.

#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "glb2idl/ast.h"
#include "glb2idl/description.h"
#include "glb2idl/expression_parser.h"
#include "glb2idl/token_reader.h"

namespace indurop::glb2idl {

class DeclarationParser {
 public:
  // Names of declarations that failed are added to `broken`.
  DeclarationParser(TokenReader& in, ExpressionParser& values, const Descriptions& descriptions,
                    std::set<std::string>& broken)
      : in_(in), values_(values), descriptions_(descriptions), broken_(broken) {}

  // Skips the rest of a declaration that failed somewhere after `begin`; stores the names in it.
  void recover(std::size_t begin, bool in_struct);
  std::optional<ast::Declaration> declaration(bool in_struct);
  // Reads the end of a declaration: ';' or the end of its line.
  bool finish(std::string_view what);

 private:
  [[nodiscard]] bool begins_declaration(const Token& token) const noexcept;
  void note_broken();
  // Returns true if declarators must follow. A type alone is a declaration if it has a name or is an enum.
  [[nodiscard]] bool declarators_follow(const ast::Declaration& found, bool in_struct) const noexcept;
  std::optional<ast::TypeSpec> type_spec();
  std::optional<ast::TypeSpec> base_type();
  std::optional<ast::TypeSpec> tagged_type(bool is_struct);
  bool struct_body(ast::TypeSpec& to);
  bool enum_body(ast::TypeSpec& to);
  std::optional<ast::Declarator> declarator(bool in_struct);
  bool declared_name(ast::Declarator& to, bool required);
  bool dimensions(ast::Declarator& to);
  // An annotation on a new line belongs to this declaration only if the declaration continues after it.
  bool trailing_annotations(ast::Declarator& to);
  bool function(ast::Declarator& to);
  // Reads a deadline, which may be before or after the annotations.
  bool deadline(ast::Declarator& to);

  TokenReader& in_;
  ExpressionParser& values_;
  const Descriptions& descriptions_;
  std::set<std::string>& broken_;
  int depth_ = 0;  // of structs
};

}  // namespace indurop::glb2idl
