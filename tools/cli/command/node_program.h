// SPDX-License-Identifier: Apache-2.0
// The program indurop-node, which verbs execute in their place.

#pragma once

#include <filesystem>

#include "config/run_options.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Searches in the folder of this program, in ../libexec/indurop, then in PATH. Returns an empty path, after a message,
// if it is not found.
std::filesystem::path node_program(Context& context);

// Returns only after an error, which has been printed, with its exit code.
int become_node(Context& context, const std::filesystem::path& program, const config::RunOptions& options);

}  // namespace indurop::tools
