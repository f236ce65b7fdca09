// SPDX-License-Identifier: Apache-2.0
// indurop-node from the same folder as this program, held open: after an update of the files the node is still the one
// that this agent knows.

#pragma once

#include <string>

namespace indurop::deploy {

// Returns an open file descriptor, or -1.
int open_node_program();
// Returns its path if it still has one, so that the list of processes shows it for the node.
std::string node_program_path(int program);

}  // namespace indurop::deploy
