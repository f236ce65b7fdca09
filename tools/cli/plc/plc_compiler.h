// SPDX-License-Identifier: Apache-2.0
// Runs g++ and glb2idl on the code generated for a PLC program. Their messages are not shown to the author of the
// program: generated code that does not compile is a fault of this compiler.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// `arguments` begin with the program and compile `code`, which was generated from `sources`. Returns false after an
// error message; the output of the program remains in a .log file in the folder of the code.
bool run_compiler(Context& context, const std::vector<std::string>& arguments, const std::filesystem::path& code,
                  const std::string& sources);

}  // namespace indurop::tools
