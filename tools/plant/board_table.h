// SPDX-License-Identifier: Apache-2.0
// All boards that were heard, a line for each: what `boards` and `status --plant` show.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "mirror/frames/mirrored_variables.h"
#include "tools/command/table.h"
#include "tools/plant/board_roster.h"

namespace indurop::tools {

// What boards read from each other, by agent.
using VariablesRead = std::map<std::uint64_t, std::vector<mirror::MirroredVariable>>;

// With `read` also what each board reads from the others and how old it is.
Table board_table(const BoardRoster& roster, std::int64_t now_ns, const VariablesRead* read = nullptr);
// Agents of other releases and who reports in the name of others, which no table can show: a line for each on stderr,
// and as JSON.
void note_others(Context& context, const BoardRoster& roster);
JsonValue json_of_others(const BoardRoster& roster);
JsonValue json_of_impostors(const BoardRoster& roster);
// Boards that others name as members of their plant and that are not there.
std::vector<std::string> boards_not_heard(const BoardRoster& roster);

}  // namespace indurop::tools
