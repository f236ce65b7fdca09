// SPDX-License-Identifier: Apache-2.0
// The words of Instruction List: operators, their modifiers, and where values meet at labels.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plc/model/ast.h"
#include "plc/st/lexer.h"

namespace indurop::plc::lower {

// AND, ANDN, ADD...: what is loaded, op, the operand.
struct BinaryWord {
  ast::Operator op = ast::Operator::None;
  bool negated = false;  // the operand
};
[[nodiscard]] std::optional<BinaryWord> binary_word(const st::Token& word);

// JMP, JMPC, JMPCN: always, if what is loaded is true, if it is false. Empty: another word than `base`.
enum class When : std::uint8_t { Always, True, False };
[[nodiscard]] std::optional<When> conditional(std::string_view word, std::string_view base);

// Labels, in capitals, in front of something else than a load or a way out: all ways to them bring a value. With the
// names of the variables for it.
[[nodiscard]] std::map<std::string, std::string> find_joints(const std::vector<st::Token>& tokens,
                                                             const std::string& prefix);

}  // namespace indurop::plc::lower
