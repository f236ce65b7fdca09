// SPDX-License-Identifier: Apache-2.0
// Reads the source of a PLC program, and prints its diagnostics.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Reads all bytes of a regular file. Returns false after an error message.
bool read_plc_file(Context& context, const std::string& file, std::string& bytes);
// Adds the files of a project of the OpenPLC Editor, which are in folders next to its project.json. Returns nothing
// after an error message: one of them is a link to a file outside the project.
std::optional<std::vector<std::string>> with_project_files(Context& context, const std::vector<std::string>& files);
// Prints "prog.st:12:5: error: text" or, for a drawing, "prog.xml:80:3: error: POU main, rung 3: text", then the source
// line, if known, with a mark.
void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::tools
