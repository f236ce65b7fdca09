// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/identifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "control/plc/model/elementary.h"

namespace indurop::plc {
namespace {

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

}  // namespace

// Long: a list.
bool is_keyword(std::string_view word) noexcept {
  // Type and function names are not included: they are ordinary names with a meaning. Neither are words that have a
  // meaning where no name can be: TASK, TRANSITION, R_EDGE.
  static constexpr std::array<std::string_view, 82> kWords{"ACTION",
                                                           "AND",
                                                           "ARRAY",
                                                           "AT",
                                                           "BY",
                                                           "CASE",
                                                           "CONFIGURATION",
                                                           "CONSTANT",
                                                           "CONTINUE",
                                                           "DO",
                                                           "ELSE",
                                                           "ELSIF",
                                                           "END_ACTION",
                                                           "END_CASE",
                                                           "END_CONFIGURATION",
                                                           "END_FOR",
                                                           "END_FUNCTION",
                                                           "END_FUNCTION_BLOCK",
                                                           "END_IF",
                                                           "END_PROGRAM",
                                                           "END_REPEAT",
                                                           "END_RESOURCE",
                                                           "END_STEP",
                                                           "END_STRUCT",
                                                           "END_TRANSITION",
                                                           "END_TYPE",
                                                           "END_VAR",
                                                           "END_WHILE",
                                                           "EXIT",
                                                           "FALSE",
                                                           "FOR",
                                                           "FUNCTION",
                                                           "FUNCTION_BLOCK",
                                                           "IF",
                                                           "INITIAL_STEP",
                                                           "JMP",
                                                           "MOD",
                                                           "NON_RETAIN",
                                                           "NOT",
                                                           "OF",
                                                           "OR",
                                                           "PERSISTENT",
                                                           "POINTER",
                                                           "PROGRAM",
                                                           "REF_TO",
                                                           "REPEAT",
                                                           "RESOURCE",
                                                           "RETAIN",
                                                           "RETURN",
                                                           "STRUCT",
                                                           "THEN",
                                                           "TO",
                                                           "TRUE",
                                                           "TYPE",
                                                           "UNTIL",
                                                           "VAR",
                                                           "VAR_ACCESS",
                                                           "VAR_CONFIG",
                                                           "VAR_EXTERNAL",
                                                           "VAR_GENERIC",
                                                           "VAR_GLOBAL",
                                                           "VAR_INPUT",
                                                           "VAR_IN_OUT",
                                                           "VAR_OUTPUT",
                                                           "VAR_STAT",
                                                           "VAR_TEMP",
                                                           "WHILE",
                                                           "WITH",
                                                           "XOR",
                                                           "CLASS",
                                                           "METHOD",
                                                           "INTERFACE",
                                                           "NAMESPACE",
                                                           "END_CLASS",
                                                           "END_GET",
                                                           "END_INTERFACE",
                                                           "END_METHOD",
                                                           "END_NAMESPACE",
                                                           "END_PROPERTY",
                                                           "END_SET",
                                                           "END_UNION",
                                                           "VAR_INST"};
  return std::any_of(kWords.begin(), kWords.end(), [&](std::string_view one) { return same_name(one, word); });
}

bool is_identifier(std::string_view text) noexcept {
  return !text.empty() && is_letter(text.front()) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

std::string why_no_name(std::string_view text) {
  if (!is_identifier(text)) {
    return fmt::format("'{}' is no name; use letters, digits and '_', and begin with a letter or '_'", text);
  }
  return is_keyword(text) ? fmt::format("'{}' is a word of the language and cannot be a name; use another one", text)
                          : std::string();
}

}  // namespace indurop::plc
