// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/deploy_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/keys/deploy_list.h"
#include "core/keys/plant_keys.h"
#include "store/vars/retain.h"
#include "store/vars/shm_file.h"

namespace indurop::deploy {

namespace fs = std::filesystem;

DeployKeys::DeployKeys(const std::string& board) : board_(board) {
  const char* named = std::getenv("INDUROP_KEYS_DIR");
  folder_ = named != nullptr && *named != '\0' ? named : "/etc/indurop/keys";
}

bool DeployKeys::any(std::error_code& error) const {
  error.clear();
  fs::directory_iterator plant(folder_, error);
  for (const fs::directory_iterator end; !error && plant != end; plant.increment(error)) {
    if (fs::exists(keys::ParticipantKeys(plant->path() / board_).deploy_key, error)) {
      return true;
    }
  }
  if (error == std::errc::no_such_file_or_directory) {
    error.clear();
  }
  return false;
}

OwnKeys DeployKeys::own(const std::string& plant) const {
  std::vector<std::string> plants;
  std::error_code error;
  fs::directory_iterator entry(folder_, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error)) {
    if (fs::exists(keys::ParticipantKeys(entry->path() / board_).certificate, error)) {
      plants.push_back(entry->path().filename().string());
    }
  }
  if (error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory) {
    return {{},
            {},
            {},
            fmt::format("not in the network of agents: the keys of this board in {} cannot be read: {}",
                        folder_.string(), error.message())};
  }
  if (plants.empty()) {
    return {};
  }
  std::sort(plants.begin(), plants.end());
  const bool runs = std::find(plants.begin(), plants.end(), plant) != plants.end();
  if (!runs && plants.size() > 1) {
    return {{},
            {},
            {},
            fmt::format("not in the network of agents: this board has keys of {} in {} and runs none of these plants; "
                        "keep only those of one plant there",
                        base::enumerate(plants), folder_.string())};
  }
  OwnKeys own{runs ? plant : plants.front(), {}, {}, {}};
  own.folder = folder_ / own.plant / board_;
  const keys::ParticipantKeys keys(own.folder);
  for (const fs::path& file : {keys.authority, keys.certificate, keys.key, keys.governance, keys.permissions,
                               keys.revoked, trust(own.plant).file()}) {
    std::error_code ignored;
    own.state += fmt::format("{} ", fs::last_write_time(file, ignored).time_since_epoch().count());
  }
  return own;
}

keys::ReceivedTrust DeployKeys::trust(const std::string& plant) const {
  return {keys::ParticipantKeys(folder_ / plant / board_), keys::received_trust(vars::state_directory(board_), plant)};
}

std::string DeployKeys::refusal(const std::string& plant, const std::string& text, const std::string& signature) const {
  std::error_code error;
  if (!any(error)) {
    // Unreadable keys must not count as no keys.
    return error ? fmt::format("the keys of this board in {} cannot be read ({}), so no order can be trusted",
                               folder_.string(), error.message())
                 : std::string{};
  }
  if (!vars::valid_node_name(plant)) {
    return "it names no plant";
  }
  const std::string key = trust(plant).current().deploy_keys;
  if (key.empty()) {
    return fmt::format("this board has keys, but none of plant {}", plant);
  }
  if (signature.empty()) {
    return fmt::format("it is not signed, and this board has a key of plant {}", plant);
  }
  return keys::signed_by_any(text, signature, key)
             ? std::string{}
             : fmt::format("it is not signed with the key of plant {} (keys send tells boards of new deployers)",
                           plant);
}

}  // namespace indurop::deploy
