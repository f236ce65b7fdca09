// SPDX-License-Identifier: Apache-2.0
// Parses declarations of variables and types. A declaration with an error is left out and reading continues after it.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/plc/model/project.h"
#include "control/plc/st/expression_parser.h"

namespace indurop::plc::st {

// Returns the access of PUBLIC, PRIVATE, PROTECTED and INTERNAL; none for other words.
std::optional<ast::Access> access_word(const Token& word) noexcept;

class DeclarationParser {
 public:
  explicit DeclarationParser(TokenReader& in) : in_(in), expressions_(in) {}

  // Returns whether VAR, VAR_INPUT, ... is next.
  [[nodiscard]] bool at_variables() const;
  // Parses VAR ... END_VAR.
  void variables(std::vector<ast::Variable>& to);
  // Parses %IX0.3, after AT.
  [[nodiscard]] bool address(ast::Variable& out);
  // Parses a type as it follows the name of a variable.
  [[nodiscard]] std::optional<ast::TypeSpec> type();
  // Parses the part after TYPE, up to and including END_TYPE.
  void types(std::vector<ast::TypeDeclaration>& to);

 private:
  struct Block {
    ast::Section section = ast::Section::Local;
    bool constant = false;
    bool retain = false;
    bool non_retain = false;
    bool is_static = false;
    bool of_instance = false;
    std::optional<ast::Access> access;
  };
  [[nodiscard]] std::optional<Block> block();
  [[nodiscard]] bool names(const Block& block, std::vector<ast::Variable>& found);
  bool declaration(const Block& block, std::vector<ast::Variable>& to);
  static bool broken(std::vector<ast::Variable>& found, std::vector<ast::Variable>& to);
  [[nodiscard]] bool one_type(std::vector<ast::TypeDeclaration>& to);
  [[nodiscard]] bool pointer(ast::TypeSpec& out);
  [[nodiscard]] bool array(ast::TypeSpec& out);
  [[nodiscard]] bool structure(ast::TypeSpec& out, std::string_view end);
  [[nodiscard]] bool enumeration(ast::TypeSpec& out);
  [[nodiscard]] bool dimension(ast::Dimension& out);
  [[nodiscard]] bool starts(ast::TypeSpec& out);
  [[nodiscard]] bool string_length(ast::TypeSpec& out);
  [[nodiscard]] bool named(ast::TypeSpec& out);
  // Returns the comment after the ';' on its line, else the one on separate lines before the declaration, which begins
  // with `first` and comes after line `before`.
  [[nodiscard]] std::string comment(const Token& first, int before) const;
  // Skips to the position after the next ';', or before `end`.
  void recover(std::string_view end);

  TokenReader& in_;
  ExpressionParser expressions_;
  int depth_ = 0;
};

}  // namespace indurop::plc::st
