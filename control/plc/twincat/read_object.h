// SPDX-License-Identifier: Apache-2.0
// Reads the files of a TwinCAT 3 project: .TcPOU, .TcDUT, .TcGVL, .TcIO, .TcTTO, and the .plcproj that names them. Each
// is XML around declarations and statements of Structured Text.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/st/chart_parser.h"

namespace indurop::plc::twincat {

// Returns the declarations of the file. `at`: place of its first character. `others`: as in st::parse_project().
[[nodiscard]] Project read_object(std::string_view bytes, const Place& at, std::vector<st::WrittenBody>& others,
                                  Diagnostics& diagnostics);

// As read_object(), for callers that show the text: no POU has statements, `bodies` has the text of each.
[[nodiscard]] Project read_declarations(std::string_view bytes, const Place& at, std::vector<st::WrittenBody>& bodies,
                                        Diagnostics& diagnostics);

// Returns the files of a project that contain its program, prefixed with the folder of the project.
[[nodiscard]] std::vector<std::string> files_of_project(std::string_view bytes, const Place& at,
                                                        Diagnostics& diagnostics);

}  // namespace indurop::plc::twincat
