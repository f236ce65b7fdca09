// SPDX-License-Identifier: Apache-2.0
// Chooses the node for a program, and opens its shared memory with messages that say what to do.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "store/vars/store.h"
#include "tools/client/node/run_view.h"
#include "tools/client/values/access.h"

namespace indurop::tools {

// Returns `asked` (--node), else $INDUROP_NODE; else of the running nodes "local" or the only one; if none runs, of
// those whose values remain. Waits for a node that is just starting.
Result<std::string, Failure> choose_node(const std::string& asked);

// Opens the store of the chosen node, or that of the boards in the network; `access.values` is then its source, and
// `access.node` the node. `names`: the requested ones; once they are known, silent boards are not waited for.
Result<vars::Store, Failure> open_store(Access& access, vars::Mode mode, const std::vector<std::string>& names = {});

// The chosen node's run block.
struct ChosenRun {
  std::string node;
  RunView run;
};
Result<ChosenRun, Failure> open_run(const std::string& asked);

// Returns "not running, last seen 3.2 s ago", for a store whose node is gone; empty if it runs.
std::string store_absence(const std::string& node, const vars::BlockHeader& header);

// Returns text and exit code for an error of opening a node's memory.
std::string explain_open_error(const Error& error, const std::string& node, bool for_writing);
int exit_code_of(const Error& error);

}  // namespace indurop::tools
