// SPDX-License-Identifier: Apache-2.0
// indurop-pools of a board, as its agent describes it (deploy/words/node_texts.h, "pools").

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/client/text/table.h"

namespace indurop::tools {

struct PoolProgram {
  struct Pool {
    std::string name;
    std::string text;  // "sent to control"
  };
  std::string state;     // running, starting, stopping, restarting
  std::int64_t pid = 0;  // 0: none
  std::uint64_t start_time = 0;
  std::string problem;
  std::vector<Pool> pools;
};

// Returns nothing if the text is not in the format of this version, or if the board sends and receives no pool.
std::optional<PoolProgram> read_pool_program(std::string_view text);
// Of a board on this machine. Nothing also if this user may not read what its agent has written.
std::optional<PoolProgram> view_pool_program(const std::string& node);
// "indurop-pools is running (pid 4713): cell::Vision::camera sent to control".
std::string line_of(const PoolProgram& program);
JsonValue json_of(const std::optional<PoolProgram>& program);

}  // namespace indurop::tools
