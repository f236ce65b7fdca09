// SPDX-License-Identifier: Apache-2.0
// The run block of a board anywhere in the network, as its agent reports it.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/client/node/node_choice.h"
#include "tools/client/values/force_view.h"

namespace indurop::tools {

struct BoardRun : ChosenRun {
  std::optional<std::vector<ForceView>> forces;  // for a board only
  vars::LockNote lock;                           // for a board only
  bool kept = false;                             // an old one from a file
};
// Parses a report of a board's agent about its node: a line of JSON and the run block (deploy/words/node_texts.h).
// `who` names the source.
Result<BoardRun, Failure> read_run(const std::string& who, const std::string& text);

}  // namespace indurop::tools
