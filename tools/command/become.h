// SPDX-License-Identifier: Apache-2.0
// A verb that becomes another program: exit code and signals are that program's own.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/command/verb.h"

namespace indurop::tools {

// Does not return, but for an error, which was said: its exit code.
int become(Context& context, const std::filesystem::path& program, std::vector<std::string> words);

}  // namespace indurop::tools
