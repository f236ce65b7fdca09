// SPDX-License-Identifier: Apache-2.0
// Reads the source of a PLC program, and prints what is wrong with it.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "tools/command/verb.h"

namespace indurop::tools {

// All bytes of an ordinary file. False after an error message.
bool read_plc_file(Context& context, const std::string& file, std::string& bytes);
// With the files of a project of the OpenPLC Editor, which lie in folders beside its project.json. None after an error
// message: one of them is a link to what lies elsewhere.
std::optional<std::vector<std::string>> with_project_files(Context& context, const std::vector<std::string>& files);
// "prog.st:12:5: error: text" or, of what is drawn, "prog.xml:80:3: error: POU main, rung 3: text", then the line of
// the source where it is known, with a mark.
void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics);

}  // namespace indurop::tools
