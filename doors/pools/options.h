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
  std::vector<std::string> send;     // pools, as typed, perhaps with "@TIME"
  std::vector<std::string> receive;  // pools, as typed
  double hz = 0;                     // most chunks of a pool per second; 0: all
  std::string plant;                 // plant whose senders are received; empty: all senders
  dds::NetworkSettings network;
  std::filesystem::path keys;  // folder from which network.security was read; empty: none
  std::int64_t report_ns = 0;  // how often counts are printed; 0: at the end only
  bool json = false;           // counts as JSON
  bool quiet = false;
};
// A value of --send.
struct SentPool {
  std::string name;
  std::int64_t every_ns = -1;  // minimum time between two chunks; -1: as all
};
// `problem` gets what is wrong with the text; empty if nothing is.
SentPool read_sent_pool(const std::string& text, std::string& problem);

void declare_options(base::Options& app, DoorOptions& options);

}  // namespace indurop::pool_door
