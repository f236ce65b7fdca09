// SPDX-License-Identifier: Apache-2.0
// indurop status --plant: all boards with an agent, and what they read from each other, from anywhere in the network.

#pragma once

#include <memory>

#include "tools/board_roster.h"
#include "tools/verb.h"

namespace indurop::tools {

struct PlantStatus {
  bool wanted = false;
  mirror::LinkSettings link;

  // Once more each time; returns the exit code.
  int show(Context& context);

 private:
  std::unique_ptr<mirror::DeployLink> open_;
  BoardRoster roster_;
};

}  // namespace indurop::tools
