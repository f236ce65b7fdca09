// SPDX-License-Identifier: Apache-2.0
// deploy.pub: the public keys that verify deployments on a board, one for each deployer, or two while a deployer's key
// is being replaced. A list of PEM, each with the deployer's name before it. Releases that support only one key read
// the first.

#pragma once

#include <string>
#include <vector>

namespace indurop::keys {

struct DeployKey {
  std::string deployer;
  bool former = false;  // old key, valid until the change to the new one is finished
  std::string pem;
};

std::vector<DeployKey> read_deploy_list(const std::string& text);
std::string deploy_list_text(const std::vector<DeployKey>& list);
// Returns true if one of the keys in `deploy_list`, the text of a deploy.pub, verifies the signature.
bool signed_by_any(const std::string& text, const std::string& signature, const std::string& deploy_list);

}  // namespace indurop::keys
