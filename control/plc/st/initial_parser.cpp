// SPDX-License-Identifier: Apache-2.0
// Parses initial values: a value, [1, 2, 3(0)] or (x := 1).

#include "control/plc/st/expression_parser.h"
#include "control/plc/st/nesting.h"

namespace indurop::plc::st {

std::optional<ast::Initial> ExpressionParser::initial(bool is_list) {
  auto first = one_initial();
  if (!first || !is_list || first->kind == ast::Initial::Kind::Array) {
    return first;
  }
  ast::Initial list;  // 1, 2, 3 without brackets, as CODESYS 2.3 has it
  list.kind = ast::Initial::Kind::Array;
  list.at = first->at;
  list.elements.push_back({"", std::nullopt, std::move(*first)});
  while (in_.accept(",")) {
    auto one = array_element();
    if (!one) {
      return std::nullopt;
    }
    list.elements.push_back(std::move(*one));
  }
  return list;
}

std::optional<ast::Initial> ExpressionParser::one_initial() {
  const Nesting nesting(depth_);
  const Token& token = in_.peek();
  if (!deeper(token, kBracket)) {
    return std::nullopt;
  }
  if (token.is("[")) {
    return array_initial();
  }
  if (token.is("(") && ((in_.peek(1).kind == TokenKind::Word && in_.peek(2).is(":=")) || in_.peek(1).is(")"))) {
    return struct_initial();
  }
  ast::Initial out;
  out.at = in_.here();
  out.value = binary(0);
  return out.value ? std::optional(std::move(out)) : std::nullopt;
}

std::optional<ast::Initial> ExpressionParser::array_initial() {
  ast::Initial out;
  out.kind = ast::Initial::Kind::Array;
  out.at = in_.place(in_.take());
  do {
    auto one = array_element();
    if (!one) {
      return std::nullopt;
    }
    out.elements.push_back(std::move(*one));
  } while (in_.accept(","));
  return in_.expect("]", "to close '['") ? std::optional(std::move(out)) : std::nullopt;
}

// value or count(value)
std::optional<ast::InitialElement> ExpressionParser::array_element() {
  ast::InitialElement out;
  const bool counted = in_.peek().kind == TokenKind::Number && in_.peek(1).is("(");
  if (counted) {
    out.count = primary();
    in_.take();
    if (!out.count) {
      return std::nullopt;
    }
  }
  auto value = initial(false);
  if (!value || (counted && !in_.expect(")", "after the repeated value"))) {
    return std::nullopt;
  }
  out.value = std::move(*value);
  return out;
}

std::optional<ast::Initial> ExpressionParser::struct_initial() {
  ast::Initial out;
  out.kind = ast::Initial::Kind::Struct;
  out.at = in_.place(in_.take());
  if (in_.accept(")")) {  // as the type has it
    return out;
  }
  do {
    ast::InitialElement element;
    if (!in_.expect_name("a field")) {
      return std::nullopt;
    }
    element.field = in_.take().text;
    auto value = in_.expect(":=", "after the field's name") ? initial(false) : std::nullopt;
    if (!value) {
      return std::nullopt;
    }
    element.value = std::move(*value);
    out.elements.push_back(std::move(element));
  } while (in_.accept(","));
  return in_.expect(")", "to close '('") ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace indurop::plc::st
