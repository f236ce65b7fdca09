// SPDX-License-Identifier: Apache-2.0
// Shared by the parts of `indurop keys`.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/keys/plant_keys.h"
#include "deploy/link/deploy_link.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

inline constexpr int kDefaultDays = 3650;
inline constexpr int kMostDays = 36500;
inline constexpr int kServerDays = 800;  // browsers refuse certificates of servers that are valid for longer than 825

struct KeysRequest {
  std::string folder;               // --dir
  std::string plant = "plant.xml";  // for init
  std::vector<std::string> boards;  // for add, renew, revoke
  std::string tool;                 // for add
  std::string viewer;               // for add
  std::string user;                 // for add
  std::string deployer;             // for add
  std::vector<std::string> read;    // patterns of variables
  std::vector<std::string> write;
  std::vector<std::string> hosts;  // for server
  int days = kDefaultDays;
  int server_days = kServerDays;
  bool opcua = false;         // for server
  bool finish = false;        // for rotate
  deploy::LinkSettings link;  // for send
};

keys::Instant until(const KeysRequest& request);
// Returns the folder of --dir, else the one in the manifest in the current folder, else "keys".
keys::PlantKeys keys_of(const KeysRequest& request);
// Checks that the keys exist, and for changes the authority's private key.
bool usable(Context& context, const keys::PlantKeys& keys);

int init_keys(Context& context, const KeysRequest& request);
int add_keys(Context& context, const KeysRequest& request);
int send_keys(Context& context, const KeysRequest& request);
int make_server(Context& context, const KeysRequest& request);

}  // namespace indurop::tools
