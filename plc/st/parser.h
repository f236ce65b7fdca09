// SPDX-License-Identifier: Apache-2.0
// Reads Structured Text: whole files, and the pieces of it that other languages contain.

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"
#include "plc/st/chart_parser.h"

namespace indurop::plc::st {

// A text and the place of its first character; all places in it count from there.
struct Text {
  std::string_view text;
  Place at;
  bool in_editor = false;  // as CODESYS shows a POU: END_PROGRAM and so on may miss at the end
};

// PROGRAM, FUNCTION, FUNCTION_BLOCK, TYPE, VAR_GLOBAL, CONFIGURATION. What has errors is left out.
// `others`: bodies that are no Structured Text; their POUs are without code in the result.
[[nodiscard]] Project parse_project(const Text& text, std::vector<WrittenBody>& others, Diagnostics& diagnostics);
// The same for those who show it: no POU has statements, `bodies` has the text of each.
[[nodiscard]] Project parse_declarations(const Text& text, std::vector<WrittenBody>& bodies, Diagnostics& diagnostics);
// The same as parse_project() of words that others have put together; `at` says which file they are of.
[[nodiscard]] Project parse_tokens(const std::vector<Token>& tokens, const Place& at, std::vector<WrittenBody>& others,
                                   Diagnostics& diagnostics);
// Statements. `c_code`: where C code stands that means nothing here, if it does.
[[nodiscard]] ast::Body parse_body(const Text& text, std::optional<Place>& c_code, Diagnostics& diagnostics);
// Exactly one; none after an error.
[[nodiscard]] std::optional<ast::Expression> parse_expression(const Text& text, Diagnostics& diagnostics);
[[nodiscard]] std::optional<ast::TypeSpec> parse_type(const Text& text, Diagnostics& diagnostics);
[[nodiscard]] std::optional<ast::Initial> parse_initial(const Text& text, Diagnostics& diagnostics);

}  // namespace indurop::plc::st
