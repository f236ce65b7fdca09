// SPDX-License-Identifier: Apache-2.0
// The program indurop-node, which verbs become.

#pragma once

#include <filesystem>

#include "config/run_options.h"
#include "tools/command/verb.h"

namespace indurop::tools {

// Beside this program, in ../libexec/indurop, else along PATH. Empty, after a message: it is not there.
std::filesystem::path node_program(Context& context);

// Does not return, but for an error, which was said: its exit code.
int become_node(Context& context, const std::filesystem::path& program, const config::RunOptions& options);

}  // namespace indurop::tools
