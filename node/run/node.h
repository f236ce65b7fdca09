// SPDX-License-Identifier: Apache-2.0
// One run of a node from the configuration to the final report: the composition root, the only code that knows all
// folders. Each phase returns its result, check() -> prepare() -> load() -> Running, and all are destroyed in reverse
// order.

#pragma once

#include "node/run/options.h"

namespace indurop::node {

// Runs to the end; returns the program's exit code.
int run_node(const Options& options);

}  // namespace indurop::node
