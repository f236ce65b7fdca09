// SPDX-License-Identifier: Apache-2.0
// The task of one board's mirror, as configured by the node. Without DDS.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "network/dds/network_settings.h"

namespace indurop::mirror {

// Modules that run one after the other write together: what they wrote is sent when their run is over.
struct Writers {
  // Returns a number that changes with every run and is odd during one. Real-time safe.
  std::function<std::uint64_t()> runs;
  bool notifies = true;  // notify() follows the end of a run; else the end is polled
  // Writers that are not seen between two runs for this time are stuck, and are no longer waited for.
  std::int64_t patience_ns = 1'000'000'000;
};

// A variable of this board that other boards read.
struct Outgoing {
  std::string variable;       // full name
  std::int64_t every_ns = 0;  // sent at most this often, 0: with every change
  bool best_effort = false;   // samples lost in the network are not repeated
  int writers = -1;           // index into Routes::writers; -1: any process may write it at any time
};

// A variable of another board that modules of this one read.
struct Incoming {
  std::string variable;
  std::string owner;  // board
};

// What a board exchanges with the others. A board that runs may get other ones.
struct Routes {
  std::deque<Writers> writers;
  std::vector<Outgoing> outgoing;
  std::vector<Incoming> incoming;
};

struct Settings {
  dds::NetworkSettings network;  // its board is the name by which other boards know this one
  std::string plant;
  bool spin = false;                // the sender may be awake early, on a core that no module uses
  std::vector<int> cores;           // cores the mirror's threads may run on; empty: all
  std::vector<std::string> boards;  // all other boards of the plant, for the report
  Routes routes;                    // at the start
};

}  // namespace indurop::mirror
