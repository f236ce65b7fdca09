// SPDX-License-Identifier: Apache-2.0
#include "control/plc/st/expression_parser.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

#include "control/plc/model/make.h"
#include "control/plc/model/walk.h"
#include "control/plc/st/literal.h"
#include "control/plc/st/nesting.h"

namespace indurop::plc::st {
namespace {

using ast::Expression;
using ast::Operator;

struct Symbol {
  std::string_view text;
  Operator op;
};
using Level = std::array<Symbol, 4>;
// Weakest first.
constexpr std::array<Level, 8> kLevels{{
    {{{"OR", Operator::Or}, {"OR_ELSE", Operator::Or}}},
    {{{"XOR", Operator::Xor}}},
    {{{"AND", Operator::And}, {"&", Operator::And}, {"AND_THEN", Operator::And}}},
    {{{"=", Operator::Equal}, {"<>", Operator::NotEqual}}},
    {{{"<", Operator::Less}, {">", Operator::Greater}, {"<=", Operator::LessEqual}, {">=", Operator::GreaterEqual}}},
    {{{"+", Operator::Add}, {"-", Operator::Subtract}}},
    {{{"*", Operator::Multiply}, {"/", Operator::Divide}, {"MOD", Operator::Modulo}}},
    {{{"**", Operator::Power}}},
}};

Operator operator_of(const Token& token, const Level& level) noexcept {
  const auto* found =
      std::find_if(level.begin(), level.end(), [&](const Symbol& s) { return !s.text.empty() && token.is(s.text); });
  return found == level.end() ? Operator::None : found->op;
}

}  // namespace

bool ExpressionParser::deeper(const Token& at, int by) {
  depth_ += by;
  if (depth_ > ast::kMaxDepth) {
    in_.error(at, fmt::format("more than {} operators, or {} brackets inside each other, in one expression; split it",
                              ast::kMaxDepth, ast::kMaxDepth / kBracket));
    return false;
  }
  return true;
}

std::optional<Expression> ExpressionParser::expression() {
  const Nesting nesting(depth_);
  return binary(0);
}

std::optional<Expression> ExpressionParser::binary(int level) {
  if (level == static_cast<int>(kLevels.size())) {
    return unary();
  }
  auto left = binary(level + 1);
  while (left) {
    const Token& token = in_.peek();
    const Operator op = operator_of(token, kLevels[static_cast<std::size_t>(level)]);
    if (op == Operator::None) {
      break;
    }
    in_.take();
    if (!deeper(token)) {
      return std::nullopt;
    }
    auto right = binary(level + 1);
    if (!right) {
      return std::nullopt;
    }
    Expression both;
    both.kind = Expression::Kind::Binary;
    both.op = op;
    both.at = in_.place(token);
    both.operands.push_back(std::move(*left));
    both.operands.push_back(std::move(*right));
    left = std::move(both);
  }
  return left;
}

std::optional<Expression> ExpressionParser::unary() {
  const Token& token = in_.peek();
  Operator op = Operator::None;
  if (token.is("NOT")) {
    op = Operator::Not;
  } else if (token.is("-") || token.is("+")) {
    op = token.is("-") ? Operator::Negate : Operator::Plus;
  }
  if (op == Operator::None) {
    return primary();
  }
  in_.take();
  if (!deeper(token)) {
    return std::nullopt;
  }
  auto operand = unary();
  if (!operand) {
    return std::nullopt;
  }
  Expression out = make::wrapped(Expression::Kind::Unary, std::move(*operand));
  out.op = op;
  out.at = in_.place(token);
  return out;
}

std::optional<Expression> ExpressionParser::primary() {
  const Token& token = in_.peek();
  Expression out;
  out.at = in_.place(token);
  if (token.kind == TokenKind::Typed) {
    return typed();
  }
  if (token.kind == TokenKind::Text && token.follows_error) {
    return std::nullopt;  // it has no end
  }
  if (token.kind == TokenKind::Number || token.kind == TokenKind::Text) {
    in_.take();
    Literal found = token.kind == TokenKind::Text ? text_literal(token.text) : number_literal(token.text);
    if (!found.value) {
      in_.error(token, std::move(found.why));
      return std::nullopt;
    }
    out.value = std::move(*found.value);
    out.value_type = found.type;
    return out;
  }
  if (token.is("TRUE") || token.is("FALSE")) {
    in_.take();
    out.value = token.is("TRUE");
    out.value_type = Elementary::Bool;
    return out;
  }
  if (in_.accept("(")) {
    const Nesting nesting(depth_);
    if (!deeper(token, kBracket)) {
      return std::nullopt;
    }
    auto inner = binary(0);
    return inner && in_.expect(")", "to close '('") ? std::move(inner) : std::nullopt;
  }
  const bool name = token.kind == TokenKind::Word && !is_keyword(token.text);
  const bool function = in_.next_is({"AND", "OR", "XOR", "MOD"}) && in_.peek(1).is("(");
  if (name || function || token.kind == TokenKind::Address) {
    return designator();
  }
  in_.missing("expected a value");
  return std::nullopt;
}

// INT#5, T#1s, Color#Red.
std::optional<Expression> ExpressionParser::typed() {
  const Token& token = in_.take();
  Literal found = typed_literal(token.text);
  Expression out;
  out.at = in_.place(token);
  if (!found.value && !found.why.empty()) {
    in_.error(token, std::move(found.why));
    return std::nullopt;
  }
  if (!found.value) {
    const std::size_t hash = token.text.find('#');
    out.kind = Expression::Kind::Name;
    out.value_enum = token.text.substr(0, hash);
    out.name = token.text.substr(hash + 1);
    if (out.name.empty() || (out.name[0] >= '0' && out.name[0] <= '9')) {
      in_.error(token, fmt::format("'{}' is not an elementary type, and there is no value of an enumeration after '#'",
                                   out.value_enum));
      return std::nullopt;
    }
    return out;
  }
  out.value = std::move(*found.value);
  out.value_type = found.type;
  if (found.negative) {
    out = make::wrapped(Expression::Kind::Unary, std::move(out));
    out.op = Operator::Negate;
  }
  return out;
}

std::optional<Expression> ExpressionParser::designator() {
  const Nesting nesting(depth_);
  const Token& token = in_.take();
  Expression out;
  out.at = in_.place(token);
  if (token.kind == TokenKind::Address) {
    const auto address = address_literal(token.text);
    if (!address) {
      in_.error(token, fmt::format("'{}' is not an address, write it as %IX0.3, %QW2 or %MD4", token.text));
      return std::nullopt;
    }
    out.kind = Expression::Kind::Direct;
    out.address = *address;
    return out;
  }
  out.kind = Expression::Kind::Name;
  out.name = token.text;
  return postfix(std::move(out));
}

std::optional<Expression> ExpressionParser::postfix(Expression base) {
  while (true) {
    const Token& token = in_.peek();
    bool ok = true;
    if (token.is(".") || token.is("::")) {  // PLC_ROBOT::I0, as C++ has it
      ok = member(base);
    } else if (token.is("[")) {
      ok = index(base);
    } else if (token.is("(")) {
      ok = call(base);
    } else if (token.is("^")) {
      in_.take();
      base = make::wrapped(Expression::Kind::Deref, std::move(base));
    } else {
      return base;
    }
    if (!ok || !deeper(token)) {
      return std::nullopt;
    }
  }
}

// .name, .3, .%X3, .%B1
bool ExpressionParser::member(Expression& base) {
  in_.take();
  const Token& token = in_.take();
  if (token.kind == TokenKind::Word) {
    base = make::wrapped(Expression::Kind::Member, std::move(base));
    base.name = token.text;
    return true;
  }
  if (const std::string path = token.kind == TokenKind::Typed ? ast::path_of(base) : ""; !path.empty()) {
    const std::size_t hash = token.text.find('#');  // Lib.Color#Red
    base = make::name(base.at, std::string(token.text.substr(hash + 1)));
    base.value_enum = path + "." + std::string(token.text.substr(0, hash));
    return true;
  }
  std::string_view digits = token.text;
  unsigned width = 1;
  if (token.kind == TokenKind::Address && digits.size() > 2) {
    const std::string size = upper(digits.substr(1, 1));
    constexpr std::array<std::pair<std::string_view, unsigned>, 4> kWidths{
        {{"X", 1U}, {"B", 8U}, {"W", 16U}, {"D", 32U}}};
    const auto known = std::find_if(kWidths.begin(), kWidths.end(), [&](const auto& one) { return one.first == size; });
    width = known == kWidths.end() ? 0U : known->second;
    digits.remove_prefix(width > 0 ? 2 : 0);
  }
  unsigned bit = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), bit);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    in_.error(token, fmt::format("expected a name or a bit number after '.', found {}", TokenReader::spelled(token)));
    return false;
  }
  base = make::wrapped(Expression::Kind::Bit, std::move(base));
  base.width = width;
  base.bit = std::min(bit, 64U) * width;
  return true;
}

bool ExpressionParser::index(Expression& base) {
  const Nesting nesting(depth_);
  if (!deeper(in_.take(), kBracket)) {
    return false;
  }
  base = make::wrapped(Expression::Kind::Index, std::move(base));
  do {
    auto one = expression();
    if (!one) {
      return false;
    }
    base.operands.push_back(std::move(*one));
  } while (in_.accept(","));
  return in_.expect("]", "to close '['");
}

bool ExpressionParser::call(Expression& base) {
  const Nesting nesting(depth_);
  if (!deeper(in_.take(), kBracket)) {
    return false;
  }
  base = make::wrapped(Expression::Kind::Call, std::move(base));
  return argument_list(base.arguments);
}

std::optional<std::vector<ast::Argument>> ExpressionParser::arguments() {
  std::vector<ast::Argument> out;
  in_.take();
  return argument_list(out) ? std::optional(std::move(out)) : std::nullopt;
}

bool ExpressionParser::argument_list(std::vector<ast::Argument>& to) {
  if (in_.accept(")")) {
    return true;
  }
  do {
    if (!to.empty() && in_.peek().is(")")) {  // as TwinCAT lets it pass
      in_.warning(in_.here(), "there is no value after the last ','");
      break;
    }
    auto one = argument();
    if (!one) {
      return false;
    }
    to.push_back(std::move(*one));
  } while (in_.accept(","));
  return in_.expect(")", "to close the arguments");
}

std::optional<ast::Argument> ExpressionParser::argument() {
  ast::Argument out;
  out.at = in_.here();
  const std::size_t negated = in_.peek().is("NOT") && in_.peek(2).is("=>") ? 1 : 0;
  const bool named =
      in_.peek(negated).kind == TokenKind::Word && (in_.peek(negated + 1).is(":=") || in_.peek(negated + 1).is("=>"));
  if (named) {
    out.negated = negated == 1;
    if (out.negated) {
      in_.take();
    }
    out.name = in_.take().text;
    out.output = in_.take().is("=>");
    if (in_.peek().is(",") || in_.peek().is(")")) {
      return out;
    }
  }
  out.value = expression();
  return out.value ? std::optional(std::move(out)) : std::nullopt;
}

}  // namespace indurop::plc::st
