// SPDX-License-Identifier: Apache-2.0
// The board or node that a verb inspects, and its run block.

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/link/deploy_link.h"
#include "tools/cli/command/verb.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/board/board_run.h"

namespace indurop::tools {

// Selects a board in the network instead of a node of this machine.
struct BoardChoice {
  bool remote = false;
  std::string board;  // empty: the only one that is discovered
  std::string file;   // alternatively: a file in which an agent saved the run block of a node that died
  deploy::LinkSettings link;
  [[nodiscard]] bool wanted() const noexcept { return remote || !board.empty(); }

  // The open link, for further rounds to request again.
  std::unique_ptr<deploy::DeployLink> open;
  BoardRoster roster;
};

// Adds --remote and --board, and with `link` --domain and related options.
void add_board_options(base::Options& app, BoardChoice& choice, bool link = true);
// Adds --from, for verbs that only read.
void add_kept_option(base::Options& app, BoardChoice& choice);

// Returns the agent of the chosen board; the failure names the boards that are present.
Result<const BoardRoster::Entry*, Failure> find_board(Context& context, BoardChoice& choice);

// Returns the current run block of the chosen board or of a node of this machine (--node), or the one in the file.
Result<BoardRun, Failure> open_run(Context& context, BoardChoice& choice);

}  // namespace indurop::tools
