// SPDX-License-Identifier: Apache-2.0
// What the mirror of one board has to do, told by the node. No DDS here.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dds/network_settings.h"

namespace indurop::mirror {

// Modules that run one after the other write together: what they wrote is sent when their run is over.
struct Writers {
  // Changes with every run and is odd while there is one. Real-time safe.
  std::function<std::uint64_t()> runs;
  bool tells = true;  // notify() follows the end of a run; else it is looked for
  // Who is not seen between two runs for so long is stuck, and is not waited for any more.
  std::int64_t patience_ns = 1'000'000'000;
};

// A variable of this board that other boards read.
struct Outgoing {
  std::string variable;       // full name
  std::int64_t every_ns = 0;  // sent at most this often, 0: with every change
  bool best_effort = false;   // what the network loses is not repeated
  int writers = -1;           // index into Settings::writers; -1: anybody may write it at any time
};

// A variable of another board that modules of this one read.
struct Incoming {
  std::string variable;
  std::string owner;  // board
};

struct Settings {
  dds::NetworkSettings network;  // its board is what the others know this one by
  std::string plant;
  bool spin = false;                // the sender may be awake early, on a core that no module uses
  std::vector<int> cores;           // the mirror's threads may run on; empty: all
  std::vector<std::string> boards;  // all others of the plant, for the report
  std::vector<Writers> writers;
  std::vector<Outgoing> outgoing;
  std::vector<Incoming> incoming;
};

}  // namespace indurop::mirror
