// SPDX-License-Identifier: Apache-2.0
// Runs g++ and glb2idl on what was written for a PLC program. What they say about that is no message for who wrote the
// program: code that does not compile is a mistake of ours.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/command/verb.h"

namespace indurop::tools {

// `arguments` begin with the program and compile `code`, which was made of `sources`. False after an error, which was
// then told; what the program said stays beside the code, in a file that ends in .log.
bool run_compiler(Context& context, const std::vector<std::string>& arguments, const std::filesystem::path& code,
                  const std::string& sources);

}  // namespace indurop::tools
