// SPDX-License-Identifier: Apache-2.0
// The entry point for all forms of PLC programs: one reader per file type; all files together are one project.

#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "control/plc/model/diagnostics.h"
#include "control/plc/model/project.h"
#include "control/plc/model/read_options.h"
#include "control/plc/plcopen/document.h"
#include "control/plc/st/chart_parser.h"
#include "glb2idl/source.h"

namespace indurop::plc {

// Reads the text of one file; `at` is the place of its first character. Parts with errors are left out. `bodies`:
// receives code that is not Structured Text; its POUs have no code in the result.
using Reader = Project (*)(std::string_view text, const Place& at, const ReadOptions& options,
                           std::vector<st::WrittenBody>& bodies, Diagnostics& diagnostics);

using DocumentReader = plcopen::Document (*)(std::string_view text, const Place& at, const ReadOptions& options,
                                             Diagnostics& diagnostics);

struct FileType {
  std::string_view ending;  // ".st"
  Reader read = nullptr;
  DocumentReader read_document = nullptr;
};
[[nodiscard]] std::span<const FileType> file_types();

// Returns the contents of all files and libraries ("motors.plclib@1.2"). Files that cannot be read are errors.
[[nodiscard]] Project read_project(const std::vector<std::string>& files, const std::vector<std::string>& libraries,
                                   const ReadOptions& options, const glb2idl::FileReader& read,
                                   Diagnostics& diagnostics);

// As read_project(), with the code of all POUs as it is written or drawn, for callers that show it or write it again.
[[nodiscard]] plcopen::Document read_document(const std::vector<std::string>& files, const ReadOptions& options,
                                              const glb2idl::FileReader& read, Diagnostics& diagnostics);

}  // namespace indurop::plc
