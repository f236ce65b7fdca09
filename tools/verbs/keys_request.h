// SPDX-License-Identifier: Apache-2.0
// What the parts of `indurop keys` have in common.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "keys/plant_keys.h"
#include "tools/command/verb.h"

namespace indurop::tools {

inline constexpr int kDefaultDays = 3650;
inline constexpr int kMostDays = 36500;

struct KeysRequest {
  std::string folder;               // --dir
  std::string plant = "plant.xml";  // of init
  std::vector<std::string> boards;  // of add, renew, revoke
  std::string tool;                 // of add
  std::string viewer;               // likewise
  std::string deployer;             // likewise
  std::vector<std::string> read;    // patterns of variables
  std::vector<std::string> write;
  int days = kDefaultDays;
  bool finish = false;  // of rotate
};

keys::Instant until(const KeysRequest& request);
// --dir, else what the manifest here says, else "keys".
keys::PlantKeys keys_of(const KeysRequest& request);
// Keys must be there, and for changes the authority's private one.
bool usable(Context& context, const keys::PlantKeys& keys);

int init_keys(Context& context, const KeysRequest& request);
int add_keys(Context& context, const KeysRequest& request);

}  // namespace indurop::tools
