// SPDX-License-Identifier: Apache-2.0
// Command line of indurop-node.

#pragma once

#include <optional>

#include "config/run_options.h"
#include "core/base/exit_code.h"

namespace indurop::node {

using Options = config::RunOptions;

// Parses the command line; `node` of the result is a name. Empty: the program must end with `exit_code` (help, version,
// usage error; already printed).
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

// Returns true if all boards of a plant run in virtual time.
bool simulates_plant(const Options& options);

}  // namespace indurop::node
