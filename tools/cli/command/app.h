// SPDX-License-Identifier: Apache-2.0
// Finds the verb on the command line, parses its options, runs it and converts the result into an exit code.

#pragma once

#include <string>
#include <vector>

namespace indurop::tools {

// `arguments` without the program's name. Returns the exit code.
int run_program(std::vector<std::string> arguments);

}  // namespace indurop::tools
