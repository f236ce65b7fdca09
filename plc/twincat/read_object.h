// SPDX-License-Identifier: Apache-2.0
// The files a TwinCAT 3 project consists of: .TcPOU, .TcDUT, .TcGVL, .TcIO, .TcTTO, and the .plcproj that names them.
// Each is XML around declarations and statements of Structured Text.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"
#include "plc/st/chart_parser.h"

namespace indurop::plc::twincat {

// What the file declares. `at`: of its first character. `others`: as st::parse_project() has it.
[[nodiscard]] Project read_object(std::string_view bytes, const Place& at, std::vector<st::WrittenBody>& others,
                                  Diagnostics& diagnostics);

// The same for those who show it: no POU has statements, `bodies` has the text of each.
[[nodiscard]] Project read_declarations(std::string_view bytes, const Place& at, std::vector<st::WrittenBody>& bodies,
                                        Diagnostics& diagnostics);

// The files of a project that hold its program, with the folder of the project before them.
[[nodiscard]] std::vector<std::string> files_of_project(std::string_view bytes, const Place& at,
                                                        Diagnostics& diagnostics);

}  // namespace indurop::plc::twincat
