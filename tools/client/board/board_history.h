// SPDX-License-Identifier: Apache-2.0
// Earlier deployments of a board, as its agent reports them.

#pragma once

#include <cstdint>
#include <map>
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
  std::string comment;
};

// Returns them by agent, oldest first; without agents that do not answer within two seconds. `self`: session of the
// link.
std::map<std::uint64_t, std::vector<PastDeployment>> fetch_histories(deploy::DeployLink& link, std::uint64_t self,
                                                                     const std::vector<std::uint64_t>& agents);

}  // namespace indurop::tools
