// SPDX-License-Identifier: Apache-2.0
// One node of this machine, seen from its files; all of them: list_nodes() in store/vars/store.h.

#pragma once

#include <string>

#include "store/vars/store.h"

namespace indurop::vars {

// Returns whether list_nodes() would include this node. Checks its own files only, however many others there are.
bool has_node(const std::string& node, Nodes which = Nodes::Near);

}  // namespace indurop::vars
