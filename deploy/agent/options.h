// SPDX-License-Identifier: Apache-2.0
// Command line of indurop-agent.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>

namespace indurop::deploy {

struct AgentOptions {
  std::string board;
  bool one_host = false;       // all boards of the plant run on this host: loopback only
  std::optional<int> domain;   // DDS domain of the agents; empty: the default
  std::string interface_name;  // network interface; empty: the only one
  std::optional<int> core;     // of all modules that name none
  bool require_rt = false;
  bool quiet = false;  // only warnings and errors
};

// Parses the command line. Else the exit code to end with (help, version, usage error; said already).
Result<AgentOptions, int> parse_options(int argc, char** argv);

}  // namespace indurop::deploy
