// SPDX-License-Identifier: Apache-2.0
// Settings with which a participant joins the network, and its keys. Independent of DDS.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace indurop::dds {

// Files of DDS Security: the credentials of this board, and those by which it verifies others. All empty: no security.
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
  std::string board;           // name shown to DDS tools and to other releases; may be empty
  std::string user_data = {};  // of the participant, for programs that look for it; may be empty
  int domain = 0;              // DDS domain, 0..230
  std::string interface_name;  // empty: the interface that has `address`, else the only one
  std::string address;         // own IP address or host name, may be empty
  bool multicast = true;       // false: other participants are found at `peers`
  std::vector<std::string> peers;
  bool one_host = false;   // all participants run on this host: loopback only
  std::size_t others = 0;  // expected number of other participants, 0: few
  // Topics that match are sent to their readers only, by topic name with wildcards. On one host all others go to all
  // participants at once, so that discovery does not cost one message for each.
  std::string unicast_topics;
  bool known_ports = false;  // reachable at its address as a peer of others, with or without multicast
  Security security;
  std::int64_t lease_ns = 500'000'000;  // a participant silent for this time is considered lost
  // One silent for this time, if it is longer, is forgotten with all it announced. A participant that discovers another
  // one again has to read all of it; on a busy machine that makes it late for the next one.
  std::int64_t forget_ns = 0;
  int fifo_priority = 0;  // of the threads that transfer values, 0: normal scheduling
  // Bytes that a reliable writer that keeps all samples may have sent without an acknowledgement before it waits; 0: as
  // usual.
  std::size_t in_flight = 0;
};

}  // namespace indurop::dds
