// SPDX-License-Identifier: Apache-2.0
// The command line of indurop-pools.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/options.h"
#include "network/dds/network_settings.h"

namespace indurop::pool_door {

struct DoorOptions {
  std::string node;
  std::vector<std::string> send;     // pools, as typed
  std::vector<std::string> receive;  // likewise
  double hz = 0;                     // most chunks of a pool per second; 0: all
  dds::NetworkSettings network;
  std::filesystem::path keys;  // folder from which network.security was read; empty: none
  std::int64_t report_ns = 0;  // how often counts are printed; 0: at the end only
  bool json = false;           // counts as JSON
  bool quiet = false;
};
void declare_options(base::Options& app, DoorOptions& options);

}  // namespace indurop::pool_door
