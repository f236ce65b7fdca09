// SPDX-License-Identifier: Apache-2.0
// The form of the texts that an agent gives about its board's node, by the names in deployment_words.h.
//   run:       {"running": true, "now_ns": CLOCK_MONOTONIC of the board,
//               "forces": [{"name", "value" as text, "raw" as JSON, "left_ns" or null,
//                           "who", "from", "reason", "lease", "variable", "offset", "size"}],
//               "lock": {"lock": "none", "tune" or "all", "who", "from", "reason", "wall_ns"}} in a line, then the run
//               block at that moment (scheduler/run_block.h), without the texts of modules; no bytes follow the line if
//               no node of the board has left a block
//   variables: {"layout": 16 hexadecimal digits} in a line, then the schema as JSON (core/schema/schema.h)
//   values:    {"layout", "running", "now_ns": CLOCK_MONOTONIC or virtual time of the board,
//               "forces" and "lock" as above, "alarms": number of them} in a line, then for each variable, in the order
//               of the schema, its freshness (i64, little endian: see below) and the bytes of its value
//   pools:     {"state": "starting", "running", "stopping" or "restarting", "pid": 0 if there is none, "start_time" of
//   it
//               as in /proc, "deaths", "problem": "" if there is none, "pools": [{"pool", "text"}]}, of indurop-pools;
//               {} if the manifest has no pool for the board
//   messages:  {"epoch_ns", "basic_period_ns", "messages": [{"who", "time_ns", "text"}]}, oldest first

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>

namespace indurop::deploy {

// An agent gives no variables and no values that are longer.
inline constexpr std::size_t kMaxValuesBytes = 4U << 20U;

// Freshness of a value: 0 for the board's own, for a value of another board its age in ns plus 1, negative while that
// board is silent.
inline constexpr std::int64_t kNeverHeard = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kNotRead = std::numeric_limits<std::int64_t>::max();  // it was being written

// The file of an agent with its text "pools", in the state folder of its board.
inline std::filesystem::path pools_file(const std::filesystem::path& state_folder) {
  return state_folder / "pools.json";
}

}  // namespace indurop::deploy
