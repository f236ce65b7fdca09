// SPDX-License-Identifier: Apache-2.0
// Returns the boards of a plant to an earlier deployment, as one deployment.

#pragma once

#include <cstdint>
#include <string>

#include "deploy/link/deploy_link.h"
#include "tools/cli/command/verb.h"

namespace indurop::tools {

struct RollbackOptions {
  std::string id;     // or its beginning; empty: the previous one
  std::string plant;  // empty: the only one
  deploy::LinkSettings link;
  std::int64_t timeout_ns = 5'000'000'000;
  std::int64_t health_ns = 3'000'000'000;
  bool allow_missing = false;
  bool restart = false;  // of the nodes, also where modules could be exchanged
};

// Prints progress and the result; returns the exit code.
int roll_back(Context& context, RollbackOptions& options);

}  // namespace indurop::tools
