// SPDX-License-Identifier: Apache-2.0
// indurop users send: gives the list of users to the boards of a plant.

#pragma once

#include <string>
#include <vector>

#include "config/model/users.h"
#include "deploy/link/deploy_link.h"
#include "tools/console/context.h"

namespace indurop::tools {

struct SendRequest {
  std::string plant;  // empty: the only one
  deploy::LinkSettings link;
};
// Returns the exit code.
int send_users(Context& context, const std::vector<config::PlantUser>& users, SendRequest request);

}  // namespace indurop::tools
