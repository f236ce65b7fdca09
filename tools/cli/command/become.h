// SPDX-License-Identifier: Apache-2.0
// Lets a verb continue as another program (exec): exit code and signals are that program's own.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Returns only after an error, which has been printed, with its exit code.
int become(Context& context, const std::filesystem::path& program, std::vector<std::string> words);

}  // namespace indurop::tools
