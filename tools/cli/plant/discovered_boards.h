// SPDX-License-Identifier: Apache-2.0
// The boards currently discovered in the network, for verbs that work on all of them.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>
#include <vector>

#include "tools/cli/command/verb.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/failure.h"

namespace indurop::tools {

// The discovered boards, and the links to them.
struct DiscoveredBoards {
  std::unique_ptr<deploy::DeployLink> link;
  BoardRoster roster;
  std::vector<deploy::BoardReport> reports;

  // Updates their reports. `only`: this board; empty: all.
  void refresh(const std::string& only);
};

// Discovers boards for up to 3 s, or until all boards of the plant, or `only`, are found; fills in missing settings of
// `link`. Errors: no board was found; interrupted.
Result<DiscoveredBoards, Failure> discover_boards(Context& context, deploy::LinkSettings& link,
                                                  const std::string& only);

}  // namespace indurop::tools
