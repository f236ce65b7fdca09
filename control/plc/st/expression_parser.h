// SPDX-License-Identifier: Apache-2.0
// Parses expressions of Structured Text with the precedence of IEC 61131-3: ( ) and calls, unary - and NOT, **, * /
// MOD, + -, < > <= >=, = <>, AND &, XOR, OR.

#pragma once

#include <optional>

#include "control/plc/model/ast.h"
#include "control/plc/st/token_reader.h"

namespace indurop::plc::st {

class ExpressionParser {
 public:
  explicit ExpressionParser(TokenReader& in) : in_(in) {}

  [[nodiscard]] std::optional<ast::Expression> expression();
  // Parses a target of := or of a call: a name with members, indices, calls.
  [[nodiscard]] std::optional<ast::Expression> designator();
  // Parses a value, [1, 2, 3(0)] or (x := 1). `is_list`: for an array, whose values may be written without brackets.
  [[nodiscard]] std::optional<ast::Initial> initial(bool is_list = false);
  // Parses (5, speed := 3).
  [[nodiscard]] std::optional<std::vector<ast::Argument>> arguments();

 private:
  [[nodiscard]] std::optional<ast::Expression> binary(int level);
  [[nodiscard]] std::optional<ast::Expression> unary();
  [[nodiscard]] std::optional<ast::Expression> primary();
  [[nodiscard]] std::optional<ast::Expression> typed();
  [[nodiscard]] std::optional<ast::Expression> postfix(ast::Expression base);
  [[nodiscard]] bool member(ast::Expression& base);
  [[nodiscard]] bool index(ast::Expression& base);
  [[nodiscard]] bool call(ast::Expression& base);
  [[nodiscard]] std::optional<ast::Argument> argument();
  [[nodiscard]] bool argument_list(std::vector<ast::Argument>& to);
  [[nodiscard]] std::optional<ast::Initial> one_initial();
  [[nodiscard]] std::optional<ast::Initial> array_initial();
  [[nodiscard]] std::optional<ast::InitialElement> array_element();
  [[nodiscard]] std::optional<ast::Initial> struct_initial();
  // Returns false with a message beyond the limit. A bracket uses more of the stack than an operator.
  [[nodiscard]] bool deeper(const Token& at, int by = 1);

  TokenReader& in_;
  int depth_ = 0;
};

}  // namespace indurop::plc::st
