// SPDX-License-Identifier: Apache-2.0
// Parses program organisation units of Structured Text.

#pragma once

#include <map>
#include <optional>

#include "control/plc/model/project.h"
#include "control/plc/st/chart_parser.h"
#include "control/plc/st/configuration_parser.h"
#include "control/plc/st/declaration_parser.h"
#include "control/plc/st/statement_parser.h"

namespace indurop::plc::st {

// AsWritten: all bodies are kept as text, including Structured Text.
enum class Bodies { Parsed, AsWritten };

class ProjectParser {
 public:
  // `in_editor`: END_PROGRAM and so on may be missing at the end of the text.
  explicit ProjectParser(TokenReader& in, bool in_editor = false, Bodies wanted = Bodies::Parsed)
      : in_(in),
        as_written_(wanted == Bodies::AsWritten),
        expressions_(in),
        declarations_(in),
        configurations_(in),
        statements_(in),
        in_editor_(in_editor) {}

  [[nodiscard]] Project project();
  // Returns bodies in other languages, of the POUs of the project.
  [[nodiscard]] std::vector<WrittenBody> take_written() { return std::move(written_); }
  // Parses statements up to the end of the text. `c_code`: set to the place of unsupported C code.
  [[nodiscard]] ast::Body whole_body(std::optional<Place>& c_code);
  // Parses statements up to `end`, which is not consumed.
  [[nodiscard]] ast::Body body(std::string_view end);

 private:
  [[nodiscard]] std::optional<WrittenBody> statements(ast::Pou& out, std::string_view end);
  [[nodiscard]] WrittenBody text_behind(const Token& before) const;
  void pou(ast::Pou::Kind kind, std::vector<ast::Pou>& to);
  [[nodiscard]] bool element(Project& out);
  void space(Project& out);
  void uses(ast::Pou& out);
  void using_directive(std::vector<ast::NameAt>& to);
  // Defined in object_parser.cpp
  void modifiers(ast::Pou& out);
  void inheritance(ast::Pou& out);
  [[nodiscard]] bool names(std::vector<ast::NameAt>& to, std::string_view what);
  [[nodiscard]] bool at_method() const;
  void methods(ast::Pou& to);
  void method(ast::Pou& to);
  void property(ast::Pou& to);
  void accessor(const ast::Pou& property, bool known, ast::Pou& to);
  static ast::Pou accessor_of(const ast::Pou& property, ast::Accessor which);
  void code(ast::Pou& out, std::string_view end);
  void object(ast::Pou::Kind kind, std::vector<ast::Pou>& to);

  [[nodiscard]] bool has_actions(std::string_view end);
  [[nodiscard]] bool name(std::string& to, std::string_view what);

  TokenReader& in_;
  bool as_written_;
  ExpressionParser expressions_;
  DeclarationParser declarations_;
  ConfigurationParser configurations_;
  StatementParser statements_;
  std::vector<WrittenBody> written_;
  std::vector<Access> accesses_;  // of its programs
  bool in_editor_;
  ast::Scope scope_;                             // the current namespace
  std::map<std::string, std::size_t> next_end_;  // next END_PROGRAM and so on, or ACTION if that comes first
};

}  // namespace indurop::plc::st
