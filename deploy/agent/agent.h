// SPDX-License-Identifier: Apache-2.0
// The agent of a board: a resident process that runs the last deployment as a child process, and takes part in new
// deployments. Needs no network to run the committed deployment. Protocol and files: docs/deploy.md.

#pragma once

#include "deploy/agent/options.h"

namespace indurop::deploy {

// Runs until a stop signal; returns the program's exit code. Becomes the agent of the board's release of the platform
// first, with the same `arguments`, those of main().
int run_agent(const AgentOptions& options, char** arguments);

}  // namespace indurop::deploy
