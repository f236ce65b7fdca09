// SPDX-License-Identifier: Apache-2.0
// How a recording is replayed: with the configuration with which it was recorded.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "config/run_options.h"
#include "core/base/problem.h"

namespace indurop::tools {

// Returns the options of a node that replays `file`. `board`: the board to replay, of a file that joins several
// recordings; else empty. `config`: the configuration to use; empty: that of the recording. Errors: not a recording of
// runs, no such board, no configuration that exists here.
Result<config::RunOptions, base::Problem> replay_setup(const std::filesystem::path& file, const std::string& board,
                                                       const std::filesystem::path& config);

}  // namespace indurop::tools
