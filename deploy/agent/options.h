// SPDX-License-Identifier: Apache-2.0
// Command line of indurop-agent.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"

namespace indurop::deploy {

struct AgentOptions {
  std::string board;
  LinkSettings link;
  std::optional<int> core;  // for all modules without one of their own
  bool require_rt = false;
  bool quiet = false;    // only warnings and errors
  bool journal = false;  // messages go to systemd's journal, those of the node too
};

// Returns the arguments for every node that the agent starts.
std::vector<std::string> node_arguments(const AgentOptions& options);
// Returns the arguments for indurop-pools, in addition to those of the manifest.
std::vector<std::string> pools_arguments(const AgentOptions& options);
// `self`: session of the agent.
LinkSettings link_settings(const AgentOptions& options, std::uint64_t self);

// Parses the command line. On error returns the exit code (help, version, usage error); the message has been printed.
Result<AgentOptions, int> parse_options(int argc, char** argv);

}  // namespace indurop::deploy
