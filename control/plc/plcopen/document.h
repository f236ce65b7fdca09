// SPDX-License-Identifier: Apache-2.0
// A PLCopen TC6 file (2.0, 2.01) as data: declarations as in all languages, code as it is written or drawn.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/network/diagram.h"

namespace indurop::plc::plcopen {

struct PouDocument {
  ast::Pou pou;  // without code
  network::PouCode code;
  std::vector<PouDocument> methods;
};

struct Document {
  Project project;  // types, globals, configurations; no POUs
  std::vector<PouDocument> pous;
};

// `name`: of the file, for messages. Parts with errors are left out.
[[nodiscard]] Document read_document(std::string_view bytes, const std::string& name, Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
