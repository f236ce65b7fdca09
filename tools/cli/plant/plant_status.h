// SPDX-License-Identifier: Apache-2.0
// indurop status --plant: all boards with an agent, and what they read from each other, from anywhere in the network.

#pragma once

#include <memory>

#include "tools/cli/command/verb.h"
#include "tools/client/board/board_roster.h"

namespace indurop::tools {

struct PlantStatus {
  bool wanted = false;
  bool check = false;  // return kCheckFailed if something is wrong with a discovered board
  deploy::LinkSettings link;

  // Shows the status again with each call; returns the exit code.
  int show(Context& context);

 private:
  std::unique_ptr<deploy::DeployLink> open_;
  BoardRoster roster_;
};

}  // namespace indurop::tools
