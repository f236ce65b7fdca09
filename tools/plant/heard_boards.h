// SPDX-License-Identifier: Apache-2.0
// The boards that are heard in the network now, for verbs that do something with all of them.

#pragma once

#include <indurop/result.h>

#include <memory>
#include <string>
#include <vector>

#include "tools/command/failure.h"
#include "tools/command/verb.h"
#include "tools/plant/board_roster.h"

namespace indurop::tools {

// Boards that were heard, and what speaks to them.
struct HeardBoards {
  std::unique_ptr<deploy::DeployLink> link;
  BoardRoster roster;
  std::vector<deploy::BoardReport> reports;

  // What they say by now. `only`: this board; empty: all.
  void refresh(const std::string& only);
};

// Listens for up to 3 s, or until all boards of the plant, or `only`, were heard; what of `link` is open is filled in.
// Errors: none was; interrupted.
Result<HeardBoards, Failure> hear_boards(Context& context, deploy::LinkSettings& link, const std::string& only);

}  // namespace indurop::tools
