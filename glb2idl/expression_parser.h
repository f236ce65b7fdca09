// SPDX-License-Identifier: Apache-2.0
// Parses expressions, values in braces and annotations.

#pragma once

#include <optional>
#include <vector>

#include "glb2idl/ast.h"
#include "glb2idl/token_reader.h"

namespace indurop::glb2idl {

class ExpressionParser {
 public:
  static constexpr int kMaxDepth = 100;
  static constexpr int kMaxOperators = 1000;

  explicit ExpressionParser(TokenReader& tokens) : in_(tokens) {}

  // `one_line`: the expression ends with its line (#define).
  std::optional<ast::Expression> expression(bool one_line = false);
  std::optional<ast::Initializer> initializer();
  // Reads any number of @name(...); returns false after an error.
  bool annotations(std::vector<ast::Annotation>& to);
  // a.b.c or a::b::c
  std::optional<ast::Path> path(std::string_view what);

 private:
  [[nodiscard]] bool more() const noexcept { return !one_line_ || !in_.peek().newline_before; }
  std::optional<ast::Expression> conditional();
  std::optional<ast::Expression> binary(int level);
  std::optional<ast::Expression> unary();
  std::optional<ast::Expression> primary();
  ast::Expression number();
  std::optional<ast::Expression> text();
  std::optional<ast::Initializer> nested_initializer();
  bool count_operator(Span at);
  bool enter(Span at);

  TokenReader& in_;
  bool one_line_ = false;
  int depth_ = 0;
  int operators_ = 0;
};

}  // namespace indurop::glb2idl
