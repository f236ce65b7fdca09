// SPDX-License-Identifier: Apache-2.0
// All boards that were heard, a line for each: what `boards` and `status --plant` show.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/board_roster.h"
#include "tools/table.h"

namespace indurop::tools {

Table board_table(const BoardRoster& roster, std::int64_t now_ns);
// Boards that others name as members of their plant and that are not there.
std::vector<std::string> boards_not_heard(const BoardRoster& roster);

}  // namespace indurop::tools
