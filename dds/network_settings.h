// SPDX-License-Identifier: Apache-2.0
// How a participant gets into the network, and by which keys it is known there. No DDS here.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace indurop::dds {

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

struct NetworkSettings {
  std::string board;           // shown to tools of DDS and to other releases, may be empty
  int domain = 0;              // DDS domain, 0..230
  std::string interface_name;  // empty: the one that has `address`, else the only one
  std::string address;         // own IP address or host name, may be empty
  bool multicast = true;       // false: others are found at `peers`
  std::vector<std::string> peers;
  bool one_host = false;     // everybody runs here: loopback only
  std::size_t others = 0;    // how many are expected, 0: few
  bool known_ports = false;  // may be found at its address by who names it as a peer, multicast or not
  Security security;
  std::int64_t lease_ns = 500'000'000;  // who is not heard for so long is gone
  int fifo_priority = 0;                // of the threads that carry values, 0: normal scheduling
};

}  // namespace indurop::dds
