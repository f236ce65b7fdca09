// SPDX-License-Identifier: Apache-2.0
// All discovered boards, one per line: the output of `boards` and `status --plant`.

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "network/mirror/frames/mirrored_variables.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/node/pool_program.h"
#include "tools/client/text/table.h"

namespace indurop::tools {

// The variables that boards read from each other, by agent.
using VariablesRead = std::map<std::uint64_t, std::vector<mirror::MirroredVariable>>;

// The state of indurop-pools of boards whose pools are sent or received, by agent.
using PoolPrograms = std::map<std::uint64_t, PoolProgram>;
// What boards were asked for in addition to their reports.
struct BoardAnswers {
  VariablesRead read;
  PoolPrograms pools;
};

// With `answers` the table also has what each board reads from the others and its age, and the state of indurop-pools.
Table board_table(const BoardRoster& roster, std::int64_t now_ns, const BoardAnswers* answers = nullptr);
// Agents of other releases and participants that report in the name of others, which are not in the table: one error
// each, and as JSON.
void note_others(Messages& messages, const BoardRoster& roster);
JsonValue json_of_others(const BoardRoster& roster);
JsonValue json_of_impostors(const BoardRoster& roster);
// Boards that others name as members of their plant and that were not discovered.
std::vector<std::string> missing_boards(const BoardRoster& roster);

}  // namespace indurop::tools
