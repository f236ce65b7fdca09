// SPDX-License-Identifier: Apache-2.0
// The variables that a board publishes to third-party tools and accepts from them, as configured by the node. Without
// DDS.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "network/dds/network_settings.h"

namespace indurop::mirror {

// A variable of this board as its own topic.
struct Exported {
  std::string variable;        // full name
  const void* type = nullptr;  // dds::TypeDescriptor of its IDL type, valid until the end
  bool writable = false;       // writing the topic sets the variable
  std::int64_t every_ns = 0;   // published at most this often, 0: kExternalEveryNs
  // Boards of the plant that have this variable too (<standby>): the one that has served longest publishes it, by the
  // same rule as the plant's readers.
  std::vector<std::string> rivals = {};
};
inline constexpr std::int64_t kExternalEveryNs = 10'000'000;
inline constexpr std::int64_t kExternalFastestNs = 1'000'000;

struct ExternalSettings {
  dds::NetworkSettings network;
  std::string plant;                // empty: a single node without a plant
  std::vector<std::string> boards;  // all boards of the plant
  bool ros2 = false;                // topics and types are named as in ROS 2
  std::vector<int> cores;           // cores the threads may run on; empty: all
  std::vector<Exported> variables;
};

}  // namespace indurop::mirror
