// SPDX-License-Identifier: Apache-2.0
// Parses statements of Structured Text. A statement with an error is left out and reading continues after it.

#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

#include "control/plc/st/expression_parser.h"

namespace indurop::plc::st {

class StatementParser {
 public:
  explicit StatementParser(TokenReader& in) : in_(in), expressions_(in) {}

  // Parses statements up to one of the words, which is not consumed, or the end of the text.
  [[nodiscard]] ast::Body list(std::initializer_list<std::string_view> ends);
  // Returns the place of C code found since the last call.
  [[nodiscard]] std::optional<Place> take_c_code() { return std::exchange(c_code_, std::nullopt); }

 private:
  using Statement = ast::Statement;

  [[nodiscard]] std::optional<Statement> statement();
  [[nodiscard]] std::optional<Statement> c_code();
  [[nodiscard]] bool fill(Statement& out);
  [[nodiscard]] bool simple(Statement& out);
  [[nodiscard]] bool set_or_reset(ast::Expression target, Statement& out);
  [[nodiscard]] bool assignment(ast::Expression target, Statement& out);
  [[nodiscard]] bool if_statement(Statement& out);
  [[nodiscard]] bool case_statement(Statement& out);
  [[nodiscard]] bool case_branch(Statement& out);
  void skip_header(std::string_view word);
  [[nodiscard]] bool headless(ast::Statement& out, std::string_view end);
  [[nodiscard]] bool for_header(ast::Statement& out);
  [[nodiscard]] bool for_statement(Statement& out);
  [[nodiscard]] bool while_statement(Statement& out);
  [[nodiscard]] bool repeat_statement(Statement& out);
  [[nodiscard]] bool labels(ast::Branch& out);
  [[nodiscard]] bool at_case_label() const;
  void recover(std::size_t from);

  TokenReader& in_;
  ExpressionParser expressions_;
  int depth_ = 0;
  std::optional<Place> c_code_;
  ast::Body before_;  // statements to insert before the one being parsed
};

}  // namespace indurop::plc::st
