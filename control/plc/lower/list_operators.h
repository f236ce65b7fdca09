// SPDX-License-Identifier: Apache-2.0
// The words of Instruction List: operators, their modifiers, and labels where values meet.

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/ast.h"
#include "control/plc/st/lexer.h"

namespace indurop::plc::lower {

// AND, ANDN, ADD...: combines the loaded value with the operand.
struct BinaryWord {
  ast::Operator op = ast::Operator::None;
  bool negated = false;  // the operand
};
[[nodiscard]] std::optional<BinaryWord> binary_word(const st::Token& word);

// JMP, JMPC, JMPCN: always, if the loaded value is true, if it is false. Empty: the word is not `base`.
enum class When : std::uint8_t { Always, True, False };
[[nodiscard]] std::optional<When> conditional(std::string_view word, std::string_view base);

// Returns the labels, in capitals, before an operator other than a load or a jump, where every path to the label brings
// a value. Each has the name of the variable for that value.
[[nodiscard]] std::map<std::string, std::string> find_joints(const std::vector<st::Token>& tokens,
                                                             const std::string& prefix);

}  // namespace indurop::plc::lower
