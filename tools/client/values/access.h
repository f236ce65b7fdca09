// SPDX-License-Identifier: Apache-2.0
// Which node or boards a program works with, and who gets its messages.

#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "network/dds/network_settings.h"
#include "tools/client/messages.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {

// Variables of boards in the network instead of a local node.
struct RemoteOptions {
  bool wanted = false;
  dds::NetworkSettings network;
  std::filesystem::path keys;            // folder from which network.security was read; empty: none
  std::int64_t wait_ns = 3'000'000'000;  // maximum time to receive boards and values
};

struct Access {
  Messages* messages = nullptr;  // never null when a function is given it
  std::string node;              // empty: choose_node() chooses one
  RemoteOptions remote;
  std::shared_ptr<ValueSource> values;  // once open_store() has opened them
};

}  // namespace indurop::tools
