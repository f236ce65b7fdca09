// SPDX-License-Identifier: Apache-2.0
#include "node/deploy_keys.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "deploy/credentials.h"
#include "deploy/plant_keys.h"
#include "vars/shm_file.h"

namespace indurop::node {
namespace {

namespace fs = std::filesystem;

}  // namespace

DeployKeys::DeployKeys(const std::string& board) : board_(board) {
  const char* named = std::getenv("INDUROP_KEYS_DIR");
  folder_ = named != nullptr && *named != '\0' ? named : "/etc/indurop/keys";
}

bool DeployKeys::any() const {
  std::error_code error;
  for (fs::directory_iterator plant(folder_, error), end; plant != end; plant.increment(error)) {
    std::error_code ignored;
    if (fs::exists(deploy::ParticipantKeys(plant->path() / board_).deploy_key, ignored)) {
      return true;
    }
  }
  return false;
}

std::string DeployKeys::refusal(const std::string& plant, const std::string& text, const std::string& signature) const {
  if (!any()) {
    return {};
  }
  if (!vars::valid_node_name(plant)) {
    return "it names no plant";
  }
  const fs::path file = deploy::ParticipantKeys(folder_ / plant / board_).deploy_key;
  std::ifstream in(file);
  const std::string key(std::istreambuf_iterator<char>(in), {});
  if (key.empty()) {
    return fmt::format("this board has keys, but none of plant {}", plant);
  }
  if (signature.empty()) {
    return fmt::format("it is not signed, and this board has a key of plant {}", plant);
  }
  return deploy::signature_holds(text, signature, key)
             ? std::string{}
             : fmt::format("it is not signed with the key of plant {}", plant);
}

}  // namespace indurop::node
