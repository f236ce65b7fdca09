// SPDX-License-Identifier: Apache-2.0
// Reads the files of the OpenPLC Editor, from version 4 on: project.json with types, globals and tasks, and one file
// for each POU. Texts (.st, .il, .dt) are those of the standard; drawn POUs (.ld, .fbd) are a text that contains a
// drawing in JSON.

#pragma once

#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/st/parser.h"

namespace indurop::plc::openplc {

// Reads the text of one POU or declaration: st::parse_project() or st::parse_declarations().
using TextReader = Project (*)(const st::Text& text, std::vector<st::WrittenBody>& others, Diagnostics& diagnostics);

// Parts with errors are left out. `others`: receives bodies that are not Structured Text.
[[nodiscard]] Project read_project(std::string_view json, const Place& at, TextReader read,
                                   std::vector<st::WrittenBody>& others, Diagnostics& diagnostics);
[[nodiscard]] Project read_drawn(std::string_view text, const Place& at, network::Body::Language language,
                                 std::vector<st::WrittenBody>& others, Diagnostics& diagnostics);

}  // namespace indurop::plc::openplc
