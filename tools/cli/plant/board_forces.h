// SPDX-License-Identifier: Apache-2.0
// set, force, unforce and forces for a board anywhere in the network, through its agent.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/cli/plant/board_run.h"

namespace indurop::tools {

struct BoardForces {
  BoardChoice board;
};
// Adds the options of add_board_options.
void add_board_force_options(base::Options& app, BoardForces& options);

// Forces all of `assignments` (NAME=VALUE) on the board for `for_ns` (0: until unforced), or none. Returns the exit
// code.
int force_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments, std::int64_t for_ns);
int set_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments);
// Holds them until the user ends it, or the board receives nothing from this program any more.
int hold_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments);
int lock_board(Context& context, BoardForces& options, const std::string& word);
// `names` empty: all.
int unforce_on_board(Context& context, BoardForces& options, const std::vector<std::string>& names);

}  // namespace indurop::tools
