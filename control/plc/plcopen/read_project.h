// SPDX-License-Identifier: Apache-2.0
// Reads PLCopen XML into the syntax tree: the entry point for drawn programs.

#pragma once

#include <string>
#include <string_view>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/st/chart_parser.h"

namespace indurop::plc::plcopen {

// `name`: of the file, for messages. `bodies`: receives the code of its POUs and methods. Check `diagnostics` before
// using the project.
[[nodiscard]] Project read_project(std::string_view bytes, const std::string& name,
                                   std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
