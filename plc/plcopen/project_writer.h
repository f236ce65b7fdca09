// SPDX-License-Identifier: Apache-2.0
// A project as a file of PLCopen TC6 XML 2.01, which editors open and read_document() reads as the same project.

#pragma once

#include <string>

#include "plc/model/diagnostics.h"
#include "plc/plcopen/document.h"

namespace indurop::plc::plcopen {

struct WriteOptions {
  std::string name;     // of the project
  std::string created;  // "2024-01-31T12:30:00"
};

// What the format does not have (methods, namespaces, references, R_EDGE) is an error; then the text is of no use.
// Without a configuration, one says what runs without one: all programs every 10 ms.
[[nodiscard]] std::string write_project(const Document& document, const WriteOptions& options,
                                        Diagnostics& diagnostics);

}  // namespace indurop::plc::plcopen
