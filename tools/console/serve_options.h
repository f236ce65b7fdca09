// SPDX-License-Identifier: Apache-2.0
// Options of `indurop serve` and of the program indurop-serve that it executes.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "deploy/link/deploy_link.h"

namespace indurop::tools {

inline constexpr double kMostFoxgloveHz = 100;

struct ServeOptions {
  std::string node;  // empty: all nodes of this host
  std::string bind = "127.0.0.1";
  std::uint64_t port = 8080;
  bool write = false;
  std::filesystem::path users;
  std::filesystem::path token_file;
  std::filesystem::path cert;
  std::filesystem::path key;
  std::filesystem::path client_ca;
  std::filesystem::path revoked;
  std::filesystem::path web;
  std::filesystem::path audit;
  std::filesystem::path recordings;
  std::vector<std::string> hosts;
  std::vector<std::string> origins;
  std::vector<std::string> foxglove;  // names of variables; none: all
  std::vector<std::string> metrics;   // variables whose values are in /metrics
  std::vector<std::string> calls;     // shared functions that clients may call
  double foxglove_hz = 50;
  std::uint64_t clients = 64;
  bool quiet = false;
  bool plant = false;  // also serve boards in the network
  deploy::LinkSettings link;
  std::vector<std::string> plc;  // programs, as plc_files() reads them
};

void declare_serve_options(base::Options& app, ServeOptions& options);
// Returns the arguments that result in the same options.
std::vector<std::string> words_of(const ServeOptions& options);
// Returns the arguments with which another program reaches the same agents.
std::vector<std::string> link_words(const deploy::LinkSettings& link);

}  // namespace indurop::tools
