// SPDX-License-Identifier: Apache-2.0
// indurop run PLANT --local: every board of a plant as a node of this host, started and ended together.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/run_options.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

// `program`: indurop-node; `options` are passed to each node, --report with the board's name added to the file name;
// their `config` is the plant. Returns the exit code of the first board that failed, 130 after Ctrl-C.
int run_local(Context& context, const std::filesystem::path& program, const config::RunOptions& options);

}  // namespace indurop::tools
