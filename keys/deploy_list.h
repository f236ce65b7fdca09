// SPDX-License-Identifier: Apache-2.0
// deploy.pub: the public keys whose signatures a board takes deployments by, one for each deployer, and for a while two
// after a deployer was given a new one. A list of PEM, with the deployer's name in front of each. Releases that know
// one key read the first.

#pragma once

#include <string>
#include <vector>

namespace indurop::keys {

struct DeployKey {
  std::string deployer;
  bool former = false;  // counts until the change to a new one is finished
  std::string pem;
};

std::vector<DeployKey> read_deploy_list(const std::string& text);
std::string deploy_list_text(const std::vector<DeployKey>& list);
// Does the signature hold by one of the keys in `text`, a deploy.pub?
bool signed_by_any(const std::string& text, const std::string& signature, const std::string& deploy_list);

}  // namespace indurop::keys
