// SPDX-License-Identifier: Apache-2.0
// Earlier deployments of a board, as its agent tells them.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"

namespace indurop::tools {

struct PastDeployment {
  std::string deployment;
  std::string plant;
  std::uint64_t generation = 0;
  std::string host;
  std::int64_t wall_ns = 0;
  std::string outcome;
};

// Oldest first; empty if the agent does not answer within two seconds, or has none. `self`: session of the link.
std::vector<PastDeployment> fetch_history(deploy::DeployLink& link, std::uint64_t self, std::uint64_t agent);

}  // namespace indurop::tools
