// SPDX-License-Identifier: Apache-2.0
// PLCopen XML to the syntax tree: the front door of everything that is drawn.

#pragma once

#include <string>
#include <string_view>

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"
#include "plc/st/chart_parser.h"

namespace indurop::plc::plcopen {

// `name`: of the file, for messages. `bodies`: the code of its POUs and methods. Check `diagnostics` before the project
// is used.
[[nodiscard]] Project read_project(std::string_view bytes, const std::string& name,
                                   std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
