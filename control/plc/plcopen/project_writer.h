// SPDX-License-Identifier: Apache-2.0
// Writes a project as a file of PLCopen TC6 XML 2.01, which editors open and read_document() reads as the same project.

#pragma once

#include <string>

#include "control/plc/model/diagnostics.h"
#include "control/plc/plcopen/document.h"

namespace indurop::plc::plcopen {

struct WriteOptions {
  std::string name;     // of the project
  std::string created;  // "2024-01-31T12:30:00"
};

// Constructs that the format does not support (methods, namespaces, references, R_EDGE) are errors; then the text must
// not be used. A project without a configuration gets one that runs the same as without: all programs every 10 ms.
[[nodiscard]] std::string write_project(const Document& document, const WriteOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
