// SPDX-License-Identifier: Apache-2.0
// indurop run --detach: a node that continues to run after this program, which returns when the node runs.

#pragma once

#include <filesystem>

#include "config/run_options.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// Starts `program` (indurop-node) in its own session; its output goes to the file node.log in the node's state
// directory. Returns when its modules run, or the node's exit code if it ended before.
int run_detached(Context& context, const std::filesystem::path& program, const config::RunOptions& options);

}  // namespace indurop::tools
