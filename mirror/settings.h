// SPDX-License-Identifier: Apache-2.0
// What the mirror of one board has to do, told by the node. No DDS here.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

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

// Files of DDS Security: what this board shows and what it judges others by. All empty: the network is open.
struct Security {
  std::string authority;
  std::string certificate;
  std::string key;
  std::string governance;
  std::string permissions;
  std::string revoked;  // may be empty
  [[nodiscard]] bool on() const noexcept { return !key.empty(); }
};

struct Settings {
  std::string plant;
  std::string board;
  int domain = 0;              // DDS domain, 0..230
  std::string interface_name;  // empty: the one that has `address`, else the only one
  std::string address;         // own IP address or host name, may be empty
  bool multicast = true;       // false: boards are found at `peers`
  std::vector<std::string> peers;
  bool one_host = false;     // all boards run here: loopback only
  bool known_ports = false;  // may be found at its address by who names it as a peer, multicast or not
  Security security;
  std::int64_t lease_ns = 500'000'000;
  int fifo_priority = 0;            // of the mirror's threads, 0: normal scheduling
  bool spin = false;                // the sender may be awake early, on a core that no module uses
  std::vector<int> cores;           // they may run on; empty: all
  std::vector<std::string> boards;  // all others of the plant, for the report
  std::vector<Writers> writers;
  std::vector<Outgoing> outgoing;
  std::vector<Incoming> incoming;
};

}  // namespace indurop::mirror
