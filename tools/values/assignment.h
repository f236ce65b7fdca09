// SPDX-License-Identifier: Apache-2.0
// NAME=VALUE as the arguments of set and force: all of them found good, or none used.

#pragma once

#include <string>
#include <vector>

#include "operate/item.h"
#include "tools/values/variables.h"

namespace indurop::tools {

using operate::Assignment;

// "a=1" "b=2", or "a" "1": types, array bounds and declared ranges are checked. A failure comes after an error message
// for each that is wrong, which names `verb`.
Result<std::vector<Assignment>, Failure> read_assignments(Context& context, const vars::Store& store, const char* verb,
                                                          const std::vector<std::string>& words);

}  // namespace indurop::tools
