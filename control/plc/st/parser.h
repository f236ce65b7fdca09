// SPDX-License-Identifier: Apache-2.0
// Reads Structured Text: whole files, and the pieces of it in other languages.

#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/st/chart_parser.h"

namespace indurop::plc::st {

// A text and the place of its first character; all places in it are relative to that.
struct Text {
  std::string_view text;
  Place at;
  bool in_editor = false;  // as CODESYS shows a POU: END_PROGRAM and so on may be missing at the end
};

// Parses PROGRAM, FUNCTION, FUNCTION_BLOCK, TYPE, VAR_GLOBAL, CONFIGURATION. Parts with errors are left out. `others`:
// receives bodies that are not Structured Text; their POUs have no code in the result.
[[nodiscard]] Project parse_project(const Text& text, std::vector<WrittenBody>& others, Diagnostics& diagnostics);
// As parse_project(), for callers that show the text: no POU has statements, `bodies` has the text of each.
[[nodiscard]] Project parse_declarations(const Text& text, std::vector<WrittenBody>& bodies, Diagnostics& diagnostics);
// As parse_project(), for tokens assembled from several places; `at` names the file.
[[nodiscard]] Project parse_tokens(const std::vector<Token>& tokens, const Place& at, std::vector<WrittenBody>& others,
                                   Diagnostics& diagnostics);
// Parses statements. `c_code`: set to the place of unsupported C code, if there is any.
[[nodiscard]] ast::Body parse_body(const Text& text, std::optional<Place>& c_code, Diagnostics& diagnostics);
// Parses exactly one expression; none after an error.
[[nodiscard]] std::optional<ast::Expression> parse_expression(const Text& text, Diagnostics& diagnostics);
[[nodiscard]] std::optional<ast::TypeSpec> parse_type(const Text& text, Diagnostics& diagnostics);
[[nodiscard]] std::optional<ast::Initial> parse_initial(const Text& text, Diagnostics& diagnostics);

}  // namespace indurop::plc::st
