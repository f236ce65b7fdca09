// SPDX-License-Identifier: Apache-2.0
// Command line of indurop-node.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "deploy/config.h"
#include "deploy/exit_code.h"

namespace indurop::node {

struct Options {
  std::filesystem::path config;
  std::string node = "local";
  std::string board;                      // of the plant that `config` is; empty: a module.xml
  std::string deployment;                 // id of what the agent runs; empty: started by hand
  bool one_host = false;                  // all boards of the plant run on this host
  std::optional<deploy::Nanos> duration;  // empty: until stopped
  std::filesystem::path report;           // empty: none
  bool require_rt = false;
  bool adjust = false;
  bool quiet = false;  // no summary, no messages of the node but warnings and errors
  std::optional<int> core;
  std::optional<deploy::SpinSetting> spin;
  bool agent = false;          // stay and run what is deployed
  std::optional<int> domain;   // of the agents
  std::string interface_name;  // of the agent
};

// Parses the command line. Empty: the program is to end with `exit_code` (help, version, usage error; said already).
std::optional<Options> parse_options(int argc, char** argv, int& exit_code);

}  // namespace indurop::node
