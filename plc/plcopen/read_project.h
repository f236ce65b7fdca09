// SPDX-License-Identifier: Apache-2.0
// PLCopen XML to the syntax tree: the front door of everything that is drawn.

#pragma once

#include <string>
#include <string_view>

#include "plc/model/diagnostics.h"
#include "plc/model/project.h"
#include "plc/model/read_options.h"
#include "plc/plcopen/document.h"

namespace indurop::plc::plcopen {

// `name`: of the file, for messages. Check `diagnostics` before the project is used.
[[nodiscard]] Project read_project(std::string_view bytes, const std::string& name, const ReadOptions& options,
                                   Diagnostics& diagnostics);

// The same from a document that was read. Its places name the rungs from then on.
[[nodiscard]] Project lower(Document& document, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
