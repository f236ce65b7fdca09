// SPDX-License-Identifier: Apache-2.0
// indurop-node beside this program, held open: after an update of the files the node is still the one this agent knows.

#pragma once

#include <string>

namespace indurop::deploy {

// An open file, or -1.
int open_node_program();
// By its name if it still has one, so that the node has it in the list of processes too.
std::string node_program_path(int program);

}  // namespace indurop::deploy
