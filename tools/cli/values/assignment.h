// SPDX-License-Identifier: Apache-2.0
// NAME=VALUE arguments of set and force: used only if all of them are valid.

#pragma once

#include <string>
#include <vector>

#include "store/operate/item.h"
#include "tools/cli/command/verb.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {

using operate::Assignment;

// Parses "a=1" "b=2", or "a" "1": checks types, array bounds and declared ranges. Before a failure an error message is
// printed for each wrong one, which names `verb`.
Result<std::vector<Assignment>, Failure> read_assignments(Context& context, const vars::Store& store, const char* verb,
                                                          const std::vector<std::string>& words);

}  // namespace indurop::tools
