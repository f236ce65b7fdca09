// SPDX-License-Identifier: Apache-2.0
// How the node of a board anywhere in the network does, as its agent shows it, for the verbs that look at a node.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/plant/board_roster.h"
#include "tools/values/force_view.h"
#include "tools/values/node_choice.h"

namespace indurop::tools {

// A board in the network instead of a node of this machine.
struct BoardChoice {
  bool remote = false;
  std::string board;  // empty: the only one that is heard
  std::string file;   // instead of both: what an agent has kept of a node that died
  deploy::LinkSettings link;
  [[nodiscard]] bool wanted() const noexcept { return remote || !board.empty(); }

  // Once it is open: further rounds ask anew.
  std::unique_ptr<deploy::DeployLink> open;
  BoardRoster roster;
};

// --remote and --board, and with `link` --domain and the like.
void add_board_options(base::Options& app, BoardChoice& choice, bool link = true);
// --from, for verbs that only look.
void add_kept_option(base::Options& app, BoardChoice& choice);

// The agent of the chosen board; a failure that names the boards there are.
Result<const BoardRoster::Entry*, Failure> find_board(Context& context, BoardChoice& choice);

struct BoardRun : ChosenRun {
  std::optional<std::vector<ForceView>> forces;  // of a board
  vars::LockNote lock;                           // likewise
  bool kept = false;                             // of long ago
};
// In what a board's agent says of its node: a line of JSON and the run block (deploy/agent/run_image.h). `who` said it.
Result<BoardRun, Failure> read_run(const std::string& who, const std::string& text);
// The chosen board's run block as it is now, that of a node of this machine (--node), or the one in the file.
Result<BoardRun, Failure> open_run(Context& context, BoardChoice& choice);

}  // namespace indurop::tools
