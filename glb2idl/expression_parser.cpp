// SPDX-License-Identifier: Apache-2.0
// Parses expressions with the precedence of C, lists in braces, annotations.

#include "glb2idl/expression_parser.h"

#include <array>
#include <span>
#include <utility>

#include "core/base/utf8.h"
#include "glb2idl/text.h"

namespace indurop::glb2idl {
namespace {

using Symbols = std::array<std::string_view, 4>;
constexpr std::array<Symbols, 10> kLevels{{{"||"},
                                           {"&&"},
                                           {"|"},
                                           {"^"},
                                           {"&"},
                                           {"==", "!="},
                                           {"<", ">", "<=", ">="},
                                           {"<<", ">>"},
                                           {"+", "-"},
                                           {"*", "/", "%"}}};

bool is_time_unit(std::string_view word) noexcept {
  return word == "ns" || word == "us" || word == "ms" || word == "s";
}

}  // namespace

std::optional<ast::Expression> ExpressionParser::expression(bool one_line) {
  one_line_ = one_line;
  depth_ = 0;
  operators_ = 0;
  auto result = conditional();
  one_line_ = false;
  return result;
}

bool ExpressionParser::enter(Span at) {
  if (++depth_ > kMaxDepth) {
    in_.error(at, fmt::format("nested more than {} levels deep, split it into constants", kMaxDepth));
    return false;
  }
  return true;
}

bool ExpressionParser::count_operator(Span at) {
  if (++operators_ > kMaxOperators) {
    in_.error(at, fmt::format("more than {} operators in one expression, split it into constants", kMaxOperators));
    return false;
  }
  return true;
}

std::optional<ast::Expression> ExpressionParser::conditional() {
  if (!enter(in_.peek().at)) {
    return std::nullopt;
  }
  auto condition = binary(0);
  if (condition && more() && in_.peek().is("?")) {
    if (!count_operator(in_.take().at)) {
      return std::nullopt;
    }
    auto yes = conditional();
    if (!yes || !in_.expect(":", "between the two values of '?'")) {
      return std::nullopt;
    }
    auto no = conditional();
    if (!no) {
      return std::nullopt;
    }
    ast::Expression result;
    result.kind = ast::Expression::Kind::Conditional;
    result.at = join(condition->at, no->at);
    result.operands = {std::move(*condition), std::move(*yes), std::move(*no)};
    condition = std::move(result);
  }
  --depth_;
  return condition;
}

std::optional<ast::Expression> ExpressionParser::binary(int level) {
  if (level == static_cast<int>(kLevels.size())) {
    return unary();
  }
  auto left = binary(level + 1);
  while (left && more()) {
    const Symbols& symbols = kLevels[static_cast<std::size_t>(level)];
    const Token& token = in_.peek();
    if (token.kind != TokenKind::Symbol || std::find(symbols.begin(), symbols.end(), token.text) == symbols.end()) {
      break;
    }
    in_.take();
    if (!count_operator(token.at)) {
      return std::nullopt;
    }
    auto right = binary(level + 1);
    if (!right) {
      return std::nullopt;
    }
    ast::Expression result;
    result.kind = ast::Expression::Kind::Binary;
    result.spelling = token.text;
    result.at = join(left->at, right->at);
    result.operands = {std::move(*left), std::move(*right)};
    left = std::move(result);
  }
  return left;
}

std::optional<ast::Expression> ExpressionParser::unary() {
  const Token& token = in_.peek();
  if (!more() || token.kind != TokenKind::Symbol ||
      std::string_view("+-!~").find(token.text) == std::string_view::npos) {
    return primary();
  }
  if (!enter(token.at) || !count_operator(token.at)) {
    return std::nullopt;
  }
  in_.take();
  auto operand = unary();
  if (!operand) {
    return std::nullopt;
  }
  --depth_;
  ast::Expression result;
  result.kind = ast::Expression::Kind::Unary;
  result.spelling = token.text;
  result.at = join(token.at, operand->at);
  result.operands.push_back(std::move(*operand));
  return result;
}

std::optional<ast::Expression> ExpressionParser::primary() {
  const Token& token = in_.peek();
  if (!more() || token.kind == TokenKind::End) {
    in_.error(in_.previous().at, "a value is missing after this");
    return std::nullopt;
  }
  ast::Expression result;
  result.at = token.at;
  if (token.kind == TokenKind::Number) {
    return number();
  }
  if (token.kind == TokenKind::Text) {
    return text();
  }
  if (token.kind == TokenKind::Character) {
    in_.take();
    const auto decoded = decode_quoted(token.text);
    if (!decoded || decoded->size() != 1 || static_cast<unsigned char>(decoded->front()) >= 0x80) {
      in_.error(token.at, "not a single ASCII character, write 'a' or '\\n'");
      return std::nullopt;
    }
    result.kind = ast::Expression::Kind::Character;
    result.spelling = *decoded;
    return result;
  }
  if (token.is("true") || token.is("false")) {
    in_.take();
    result.kind = ast::Expression::Kind::Bool;
    result.spelling = token.text;
    return result;
  }
  if (token.is("sizeof")) {
    in_.error(token.at, "sizeof is not known here, write the number");
    return std::nullopt;
  }
  if (token.kind == TokenKind::Identifier) {
    auto found = path("a constant");
    if (!found) {
      return std::nullopt;
    }
    result.kind = ast::Expression::Kind::Path;
    result.at = found->at;
    result.path = std::move(*found);
    return result;
  }
  if (in_.accept("(")) {
    auto inner = conditional();
    if (!inner || !in_.expect(")", "to close '('")) {
      return std::nullopt;
    }
    inner->at = join(token.at, in_.previous().at);
    return inner;
  }
  in_.error(token.at, fmt::format("expected a value, found {}", TokenReader::spelled(token)));
  return std::nullopt;
}

// Reads a number with the unit of time that may directly follow it.
ast::Expression ExpressionParser::number() {
  ast::Expression result;
  const Token& token = in_.take();
  result.at = token.at;
  result.spelling = token.text;
  const Token& unit = in_.peek();
  if (unit.kind == TokenKind::Identifier && !unit.newline_before && is_time_unit(unit.text)) {
    result.spelling += unit.text;
    result.at = join(token.at, in_.take().at);
  }
  return result;
}

// Adjacent texts are joined, as in C.
std::optional<ast::Expression> ExpressionParser::text() {
  ast::Expression result;
  result.kind = ast::Expression::Kind::Text;
  result.at = in_.peek().at;
  while (in_.peek().kind == TokenKind::Text && (more() || result.spelling.empty())) {
    const Token& token = in_.take();
    auto decoded = decode_quoted(token.text);
    if (!decoded || decoded->find('\0') != std::string::npos || base::first_invalid_utf8(*decoded)) {
      in_.error(token.at, "a text is UTF-8 without NUL; escapes are \\n \\t \\r \\\" \\' \\\\ \\xHH, correct it");
      return std::nullopt;
    }
    result.spelling += *decoded;
    result.at = join(result.at, token.at);
  }
  return result;
}

std::optional<ast::Path> ExpressionParser::path(std::string_view what) {
  ast::Path result;
  if (in_.peek().kind != TokenKind::Identifier) {
    in_.error(in_.peek().at, fmt::format("expected the name of {}, found {}", what, TokenReader::spelled(in_.peek())));
    return std::nullopt;
  }
  result.at = in_.peek().at;
  result.parts.emplace_back(in_.take().text);
  while ((in_.peek().is(".") || in_.peek().is("::")) && !in_.peek().newline_before) {
    in_.take();
    if (in_.peek().kind != TokenKind::Identifier || in_.peek().newline_before) {
      in_.error(in_.previous().at, "a name is missing after this");
      return std::nullopt;
    }
    result.at = join(result.at, in_.peek().at);
    result.parts.emplace_back(in_.take().text);
  }
  return result;
}

std::optional<ast::Initializer> ExpressionParser::initializer() {
  depth_ = 0;
  operators_ = 0;
  return nested_initializer();
}

std::optional<ast::Initializer> ExpressionParser::nested_initializer() {
  ast::Initializer result;
  result.at = in_.peek().at;
  if (!in_.accept("{")) {
    const int depth = depth_;
    operators_ = 0;
    result.value = conditional();
    depth_ = depth;
    if (!result.value) {
      return std::nullopt;
    }
    result.at = result.value->at;
    return result;
  }
  if (!enter(result.at)) {
    return std::nullopt;
  }
  while (!in_.accept("}")) {
    auto item = nested_initializer();
    if (!item) {
      return std::nullopt;
    }
    result.list.push_back(std::move(*item));
    if (!in_.accept(",") && !in_.peek().is("}")) {
      in_.error(in_.peek().at,
                fmt::format("expected ',' or '}}' in this list, found {}", TokenReader::spelled(in_.peek())));
      return std::nullopt;
    }
  }
  --depth_;
  result.at = join(result.at, in_.previous().at);
  return result;
}

bool ExpressionParser::annotations(std::vector<ast::Annotation>& to) {
  while (in_.peek().is("@")) {
    ast::Annotation result;
    result.at = in_.take().at;
    const Token& name = in_.peek();
    if (name.kind != TokenKind::Identifier) {
      in_.error(
          name.at,
          "the annotation's name is missing after '@': unit, range, retain, view, maxage, fallback, alarm or desc");
      return false;
    }
    in_.take();
    result.name = {std::string(name.text), name.at};
    if (in_.accept("(") && !in_.accept(")")) {
      do {
        auto argument = initializer();
        if (!argument) {
          return false;
        }
        result.arguments.push_back(std::move(*argument));
      } while (in_.accept(","));
      if (!in_.expect(")", "to close the annotation")) {
        return false;
      }
    }
    result.at = join(result.at, in_.previous().at);
    to.push_back(std::move(result));
  }
  return true;
}

}  // namespace indurop::glb2idl
