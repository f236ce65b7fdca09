// SPDX-License-Identifier: Apache-2.0
// Which node a verb talks to, and opening its shared memory with messages that say what to do.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/command/verb.h"
#include "tools/values/run_view.h"
#include "tools/values/value_source.h"
#include "vars/store.h"

namespace indurop::tools {

// `asked` (--node), else $INDUROP_NODE; else of the nodes that run "local" or the only one; if none runs, of those that
// left values behind. A node that is just starting is waited for.
Result<std::string, Failure> choose_node(const std::string& asked);

// The store of the chosen node, or with --remote of the boards in the network; `context.values` is then its source.
// `names`: those that are wanted; silent boards are not waited for once they are known.
Result<vars::Store, Failure> open_store(Context& context, vars::Mode mode, const std::vector<std::string>& names = {});

// The chosen node's run block.
struct ChosenRun {
  std::string node;
  RunView run;
};
Result<ChosenRun, Failure> open_run(const std::string& asked);

// "not running, last seen 3.2 s ago", for a store whose node is gone; empty if it runs.
std::string store_absence(const std::string& node, const vars::BlockHeader& header);

// Text and exit code for an error met when opening a node's memory.
std::string explain_open_error(const Error& error, const std::string& node, bool for_writing);
int exit_code_of(const Error& error);

}  // namespace indurop::tools
