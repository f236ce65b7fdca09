// SPDX-License-Identifier: Apache-2.0
// Plans which variables are on each module's track, and how long the tracks are.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "store/vars/layout.h"

namespace indurop::tape {

// The variables of one module of the schedule. Indices into the store's directory, each once.
struct ModuleAccess {
  std::uint32_t module = 0;
  std::int64_t period_ns = 0;  // period of its runs; for sporadic modules: of its condition checks
  std::vector<std::uint32_t> reads;
  std::vector<std::uint32_t> writes;
};

struct TrackPlan {
  std::uint32_t module = 0;
  std::uint64_t words = 0;  // of the ring
  std::vector<std::uint32_t> only_read;
  std::vector<std::uint32_t> both;  // read and written
  std::vector<std::uint32_t> only_written;
};

struct TapePlan {
  std::vector<TrackPlan> tracks;
  std::vector<bool> taped;         // for each variable of the directory
  std::int64_t reach_ns = 0;       // minimum history available to a reader, of the module that has least
  std::uint64_t bytes_wanted = 0;  // size at which reach_ns would be as requested
};

// A reader finds the last `reach_ns` on the tracks even if every value changes in every run and each run reads the
// clock twice, or as much of it as fits into `bytes` altogether; if that is less, all modules keep about the same
// duration. Answers of functions and channels to runs take their space from that. Variables that no module of the
// schedule uses get a track of their own, which is written in each basic period. A value larger than an eighth of
// `bytes` is on no track.
TapePlan plan_tape(std::span<const ModuleAccess> modules, std::span<const vars::DirectoryEntry> directory,
                   std::int64_t basic_period_ns, std::int64_t reach_ns, std::uint64_t bytes);

}  // namespace indurop::tape
