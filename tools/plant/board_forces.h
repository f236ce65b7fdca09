// SPDX-License-Identifier: Apache-2.0
// set, force, unforce and forces on a board anywhere in the network, through its agent.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/plant/board_run.h"

namespace indurop::tools {

struct BoardForces {
  BoardChoice board;
};
// Those of add_board_options.
void add_board_force_options(base::Options& app, BoardForces& options);

// The board holds all of `assignments` (NAME=VALUE) for `for_ns` (0: until unforced), or none. Returns the exit code.
int force_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments, std::int64_t for_ns);
int set_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments);
// Held until the user ends it, or the board does not hear of this program any more.
int hold_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments);
int lock_board(Context& context, BoardForces& options, const std::string& word);
// No names: all.
int unforce_on_board(Context& context, BoardForces& options, const std::vector<std::string>& names);

}  // namespace indurop::tools
