// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/deploy_keys.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

#include "base/read_file.h"
#include "keys/credentials.h"
#include "keys/plant_keys.h"
#include "vars/shm_file.h"

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

std::string DeployKeys::refusal(const std::string& plant, const std::string& text, const std::string& signature) const {
  std::error_code error;
  if (!any(error)) {
    // Keys that cannot be seen must not count as none.
    return error ? fmt::format("the keys of this board in {} cannot be read ({}), so nobody can be trusted",
                               folder_.string(), error.message())
                 : std::string{};
  }
  if (!vars::valid_node_name(plant)) {
    return "it names no plant";
  }
  const fs::path file = keys::ParticipantKeys(folder_ / plant / board_).deploy_key;
  auto content = base::read_file(file);
  const std::string key = content ? std::move(*content) : std::string{};
  if (key.empty()) {
    return fmt::format("this board has keys, but none of plant {}", plant);
  }
  if (signature.empty()) {
    return fmt::format("it is not signed, and this board has a key of plant {}", plant);
  }
  return keys::signature_holds(text, signature, key) ? std::string{}
                                                     : fmt::format("it is not signed with the key of plant {}", plant);
}

}  // namespace indurop::deploy
