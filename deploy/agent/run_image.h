// SPDX-License-Identifier: Apache-2.0
// The run block of a board's node (scheduler/run_block.h) for remote tools: a line of JSON about the moment it was
// copied, then the block at that moment, without the texts of modules. The JSON:
//   {"running": true, "now_ns": CLOCK_MONOTONIC of the board,
//    "forces": [{"name", "value" as text, "raw" as JSON, "left_ns" or null,
//                "who", "from", "reason", "lease", "variable", "offset", "size"}],
//    "lock": {"lock": "none", "tune" or "all", "who", "from", "reason", "wall_ns"}}

#pragma once

#include <string>

#include "core/base/json.h"

namespace indurop::deploy {

// No bytes follow the line if no node of this board has left a block. Log entries that were being written during the
// copy are marked as such. Only reads; not real-time safe.
std::string run_image(const std::string& board);
// Return its "forces" and "lock".
base::Json forces_to_json(const std::string& board);
base::Json lock_to_json(const std::string& board);

}  // namespace indurop::deploy
