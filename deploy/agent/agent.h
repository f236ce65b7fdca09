// SPDX-License-Identifier: Apache-2.0
// The agent of a board: resident, runs what was deployed to the board last as a child process, and takes part in new
// deployments. Needs no network to run what is committed. Protocol and files: docs/deploy.md.

#pragma once

#include "deploy/agent/options.h"

namespace indurop::deploy {

// Until a stop signal; returns the program's exit code.
int run_agent(const AgentOptions& options);

}  // namespace indurop::deploy
