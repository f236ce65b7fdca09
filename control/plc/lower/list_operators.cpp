// SPDX-License-Identifier: Apache-2.0
#include "control/plc/lower/list_operators.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/plc/model/elementary.h"

namespace indurop::plc::lower {
namespace {

using ast::Operator;

struct Binary {
  std::string_view word;
  Operator op;
  bool can_negate;
};

constexpr std::array<Binary, 15> kBinary{{{"AND", Operator::And, true},
                                          {"&", Operator::And, true},
                                          {"OR", Operator::Or, true},
                                          {"XOR", Operator::Xor, true},
                                          {"ADD", Operator::Add, false},
                                          {"SUB", Operator::Subtract, false},
                                          {"MUL", Operator::Multiply, false},
                                          {"DIV", Operator::Divide, false},
                                          {"MOD", Operator::Modulo, false},
                                          {"GT", Operator::Greater, false},
                                          {"GE", Operator::GreaterEqual, false},
                                          {"EQ", Operator::Equal, false},
                                          {"NE", Operator::NotEqual, false},
                                          {"LE", Operator::LessEqual, false},
                                          {"LT", Operator::Less, false}}};

}  // namespace

std::optional<BinaryWord> binary_word(const st::Token& word) {
  for (const Binary& each : kBinary) {
    const bool negated = each.can_negate && same_name(word.text, std::string(each.word) + "N");
    if (negated || same_name(word.text, each.word)) {
      return BinaryWord{each.op, negated};
    }
  }
  return std::nullopt;
}

std::optional<When> conditional(std::string_view word, std::string_view base) {
  if (same_name(word, base)) {
    return When::Always;
  }
  if (!same_name(word.substr(0, base.size()), base)) {
    return std::nullopt;
  }
  const std::string_view rest = word.substr(base.size());
  return same_name(rest, "C")    ? std::optional(When::True)
         : same_name(rest, "CN") ? std::optional(When::False)
                                 : std::nullopt;
}

std::map<std::string, std::string> find_joints(const std::vector<st::Token>& tokens, const std::string& prefix) {
  std::map<std::string, std::string> joints;
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
    if (tokens[i].kind != st::TokenKind::Word || !tokens[i + 1].is(":")) {
      continue;
    }
    std::size_t next = i + 2;
    while (next + 1 < tokens.size() && tokens[next + 1].is(":")) {
      next += 2;
    }
    constexpr std::array<std::string_view, 5> kFresh{"LD", "LDN", "JMP", "RET", "CAL"};
    const st::Token& word = tokens[next];
    const bool uses =
        word.kind == st::TokenKind::Word &&
        std::none_of(kFresh.begin(), kFresh.end(), [&](std::string_view fresh) { return word.is(fresh); }) &&
        !tokens[next + 1].is("(");
    if (uses) {
      joints.emplace(upper(tokens[i].text), fmt::format("_il{}{}", prefix, tokens[i].text));
    }
  }
  return joints;
}

}  // namespace indurop::plc::lower
