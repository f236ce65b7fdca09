// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/expression_text.h"

#include <indurop/plc/text_write.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/plc/model/characters.h"

namespace indurop::plc {
namespace {

using ast::Expression;
using ast::Operator;

struct Spelling {
  Operator op;
  std::string_view text;
  int strength;  // precedence
};

constexpr std::array<Spelling, 17> kSpellings{{{Operator::Not, "NOT ", 9},
                                               {Operator::Negate, "-", 9},
                                               {Operator::Plus, "+", 9},
                                               {Operator::Power, " ** ", 8},
                                               {Operator::Multiply, " * ", 7},
                                               {Operator::Divide, " / ", 7},
                                               {Operator::Modulo, " MOD ", 7},
                                               {Operator::Add, " + ", 6},
                                               {Operator::Subtract, " - ", 6},
                                               {Operator::Less, " < ", 5},
                                               {Operator::Greater, " > ", 5},
                                               {Operator::LessEqual, " <= ", 5},
                                               {Operator::GreaterEqual, " >= ", 5},
                                               {Operator::Equal, " = ", 4},
                                               {Operator::NotEqual, " <> ", 4},
                                               {Operator::And, " AND ", 3},
                                               {Operator::Xor, " XOR ", 2}}};
constexpr Spelling kOr{Operator::Or, " OR ", 1};

const Spelling& spelling(Operator op) {
  const auto* found = std::find_if(kSpellings.begin(), kSpellings.end(), [&](const Spelling& s) { return s.op == op; });
  return found == kSpellings.end() ? kOr : *found;
}

std::string real_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find('.') == std::string::npos) {
    text.insert(std::min(text.find('e'), text.size()), ".0");
  }
  return text;
}

std::string literal_text(const Expression& expression) {
  if (const auto* time = std::get_if<std::int64_t>(&expression.value)) {
    return time_text(*time, expression.value_type.value_or(Elementary::Time));
  }
  if (const auto* text = std::get_if<std::string>(&expression.value)) {
    return expression.value_type == Elementary::Wstring ? wide_quoted_text(*text) : quoted_text(*text);
  }
  std::string plain;
  if (const bool* truth = std::get_if<bool>(&expression.value)) {
    return *truth ? "TRUE" : "FALSE";
  }
  if (const auto* real = std::get_if<double>(&expression.value)) {
    plain = real_text(*real);
  } else {
    plain = std::to_string(std::get<std::uint64_t>(expression.value));
  }
  return expression.value_type ? fmt::format("{}#{}", name_of(*expression.value_type), plain) : plain;
}

std::string text_of(const Expression& expression, int around = 0);

std::string call_text(const Expression& call) {
  std::string text = text_of(call.operands.front()) + "(";
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const ast::Argument& argument = call.arguments[i];
    text += i == 0 ? "" : ", ";
    text += argument.negated ? "NOT " : "";
    text += argument.name.empty() ? "" : argument.name + (argument.output ? " => " : " := ");
    text += argument.value ? text_of(*argument.value) : "";
  }
  return text + ")";
}

std::string index_text(const Expression& expression) {
  std::string text = text_of(expression.operands.front()) + "[";
  for (std::size_t i = 1; i < expression.operands.size(); ++i) {
    text += (i == 1 ? "" : ", ") + text_of(expression.operands[i]);
  }
  return text + "]";
}

// `around`: precedence of the operator of which it is an operand.
std::string text_of(const Expression& expression, int around) {
  switch (expression.kind) {
    case Expression::Kind::Literal:
      return literal_text(expression);
    case Expression::Kind::Name:
      return expression.value_enum.empty() ? expression.name : expression.value_enum + "#" + expression.name;
    case Expression::Kind::Direct:
      return to_string(expression.address);
    case Expression::Kind::Member:
      return text_of(expression.operands.front()) + "." + expression.name;
    case Expression::Kind::Bit:
      if (expression.width > 1) {
        const char size = expression.width == 8 ? 'B' : expression.width == 16 ? 'W' : 'D';
        return fmt::format("{}.%{}{}", text_of(expression.operands.front()), size, expression.bit / expression.width);
      }
      return fmt::format("{}.{}", text_of(expression.operands.front()), expression.bit);
    case Expression::Kind::Index:
      return index_text(expression);
    case Expression::Kind::Deref:
      return text_of(expression.operands.front()) + "^";
    case Expression::Kind::Call:
      return call_text(expression);
    case Expression::Kind::Unary:
    case Expression::Kind::Binary:
      break;
  }
  const Spelling& op = spelling(expression.op);
  const bool unary = expression.kind == Expression::Kind::Unary;
  const bool signs = unary && expression.op != Operator::Not && expression.operands[0].kind == Expression::Kind::Unary;
  const std::string text = unary ? std::string(op.text) + text_of(expression.operands[0], op.strength + (signs ? 1 : 0))
                                 : text_of(expression.operands[0], op.strength) + std::string(op.text) +
                                       text_of(expression.operands[1], op.strength + 1);
  return op.strength < around ? "(" + text + ")" : text;
}

}  // namespace

std::string expression_text(const Expression& expression) {
  return text_of(expression);
}

std::string time_text(std::int64_t ns, Elementary type) {
  switch (type) {
    case Elementary::Date:
      return std::string(iec::to_string(iec::Date{ns}).view());
    case Elementary::TimeOfDay:
      return std::string(iec::to_string(iec::TimeOfDay{ns}).view());
    case Elementary::DateAndTime:
      return std::string(iec::to_string(iec::DateTime{ns}).view());
    default:
      return duration_text(ns);
  }
}

std::string quoted_text(std::string_view value) {
  std::string text = "'";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    const bool shown = byte >= 0x20 && byte < 0x7F;
    text += c == '$' || c == '\'' ? std::string{'$', c} : shown ? std::string{c} : fmt::format("${:02X}", byte);
  }
  return text + "'";
}

std::string wide_quoted_text(std::string_view utf8) {
  std::u16string text = u"\"";
  const std::u16string wide = to_wide(utf8);
  const auto is_half = [&](std::size_t i, unsigned which) { return i < wide.size() && (wide[i] & 0xFC00U) == which; };
  for (std::size_t i = 0; i < wide.size(); ++i) {
    const char16_t one = wide[i];
    const bool pair = is_half(i, 0xD800) && is_half(i + 1, 0xDC00);
    const bool alone = one >= 0xD800 && one < 0xE000 && !pair;
    if (one < 0x20 || (one >= 0x7F && one < 0xA0) || alone) {
      text += to_wide(fmt::format("${:04X}", static_cast<unsigned>(one)));
      continue;
    }
    text += one == '$' || one == '"' ? u"$" : u"";
    text += one;
    if (pair) {
      text += wide[++i];
    }
  }
  return to_utf8(text) + "\"";
}

std::string duration_text(std::int64_t ns) {
  return std::string(iec::to_string(iec::Time{ns}).view());
}

}  // namespace indurop::plc
