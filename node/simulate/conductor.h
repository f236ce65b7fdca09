// SPDX-License-Identifier: Apache-2.0
// Runs a plant in virtual time: every board is a node of its own, all advance together, and the network between them is
// simulated. No board advances beyond the first message that could still reach it, so the run is the same however fast
// each board is.

#pragma once

#include "node/run/options.h"

namespace indurop::node {

// Runs to the end; returns the program's exit code.
int run_plant(const Options& options);

}  // namespace indurop::node
