// SPDX-License-Identifier: Apache-2.0
// The run block of a board's node (scheduler/run_block.h) for tools elsewhere: a line of JSON about the moment it was
// taken, then the block as it was then, without the texts of modules. The JSON:
//   {"running": true, "now_ns": CLOCK_MONOTONIC of the board,
//    "forces": [{"name", "value" as text, "raw" as JSON, "left_ns" or null,
//                "who", "from", "reason", "lease", "variable", "offset", "size"}],
//    "lock": {"lock": "none", "tune" or "all", "who", "from", "reason", "wall_ns"}}

#pragma once

#include <string>

#include "base/json.h"

namespace indurop::deploy {

// No bytes after the line: no node of this board has left anything to see. Entries of the logs that were being written
// meanwhile are marked as such. Only reads; not real-time safe.
std::string run_image(const std::string& board);
// "forces" and "lock" of it.
base::Json told_forces(const std::string& board);
base::Json told_lock(const std::string& board);

}  // namespace indurop::deploy
