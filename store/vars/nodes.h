// SPDX-License-Identifier: Apache-2.0
// One node of this machine, seen from its files; all of them: list_nodes() in store/vars/store.h.

#pragma once

#include <string>
#include <vector>

#include "store/vars/store.h"

namespace indurop::vars {

// Returns whether list_nodes() would include this node. Checks its own files only, however many others there are.
bool has_node(const std::string& node, Nodes which = Nodes::Near);

// Names of the nodes near this user that run, sorted.
std::vector<std::string> running_nodes();
// Returns true if a process runs the node and the store is of this process, not of an earlier one.
bool is_running(const std::string& node, const BlockHeader& header);

// Returns $INDUROP_NODE; empty if it is not set.
std::string node_of_environment();
// The node that is meant if none is named: of these the default one of this user, "local", or the only one; empty if
// that does not decide.
std::string usual_node(const std::vector<std::string>& names);

}  // namespace indurop::vars
