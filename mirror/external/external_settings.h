// SPDX-License-Identifier: Apache-2.0
// What a board shows to tools of others and takes from them, told by the node. No DDS here.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dds/network_settings.h"

namespace indurop::mirror {

// A variable of this board as a topic of its own.
struct Exported {
  std::string variable;        // full name
  const void* type = nullptr;  // dds::TypeDescriptor of its IDL type, valid until the end
  bool writable = false;       // whoever writes the topic sets the variable
  std::int64_t every_ns = 0;   // published at most this often, 0: kExternalEveryNs
  // Boards of the plant that have it too (<standby>): it is shown by the one that has served longest, as the plant's
  // readers decide.
  std::vector<std::string> rivals = {};
};
inline constexpr std::int64_t kExternalEveryNs = 10'000'000;
inline constexpr std::int64_t kExternalFastestNs = 1'000'000;

struct ExternalSettings {
  dds::NetworkSettings network;
  std::string plant;                // empty: a node of its own
  std::vector<std::string> boards;  // of the plant
  bool ros2 = false;                // topics and types have the names of ROS 2
  std::vector<int> cores;           // the threads may run on; empty: all
  std::vector<Exported> variables;
};

}  // namespace indurop::mirror
