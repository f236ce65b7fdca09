// SPDX-License-Identifier: Apache-2.0
#include "core/keys/deploy_list.h"

#include <algorithm>
#include <sstream>

#include "core/keys/credentials.h"

namespace indurop::keys {
namespace {

constexpr const char* kFormer = "former";
constexpr const char* kFirst = "deployer";  // default owner of a key without a name: from releases with one key

}  // namespace

std::vector<DeployKey> read_deploy_list(const std::string& text) {
  std::vector<DeployKey> list;
  DeployKey next{kFirst, false, {}};
  bool inside = false;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    inside = inside || line.starts_with("-----BEGIN PUBLIC KEY-----");
    if (inside) {
      next.pem += line + "\n";
    } else if (line.starts_with("# ")) {
      std::istringstream words(line.substr(2));
      std::string former;
      words >> next.deployer >> former;
      next.former = former == kFormer;
    }
    if (inside && line.starts_with("-----END PUBLIC KEY-----")) {
      list.push_back(std::move(next));
      next = {kFirst, false, {}};
      inside = false;
    }
  }
  return list;
}

std::string deploy_list_text(const std::vector<DeployKey>& list) {
  std::string text;
  for (const DeployKey& key : list) {
    text += "# " + key.deployer + (key.former ? std::string(" ") + kFormer : "") + "\n" + key.pem;
  }
  return text.empty() ? "# no deployer\n" : text;
}

bool signed_by_any(const std::string& text, const std::string& signature, const std::string& deploy_list) {
  const std::vector<DeployKey> list = read_deploy_list(deploy_list);
  return std::any_of(list.begin(), list.end(),
                     [&](const DeployKey& key) { return signature_holds(text, signature, key.pem); });
}

}  // namespace indurop::keys
