// SPDX-License-Identifier: Apache-2.0
// Which variables each module's track tells, and how long the tracks are.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vars/layout.h"

namespace indurop::tape {

// Of one module of the schedule. Indices into the store's directory, each once.
struct ModuleAccess {
  std::uint32_t module = 0;
  std::int64_t period_ns = 0;  // of its runs; sporadic ones: how often it is asked
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
  std::vector<bool> taped;         // of each variable of the directory
  std::int64_t reach_ns = 0;       // what a reader finds at least, of the module of which there is least
  std::uint64_t bytes_wanted = 0;  // so that this would be what was asked for
};

// A reader finds the last `reach_ns` on the tracks even if every value changes at every run and each run asks twice for
// the time, or as much of it as fits into `bytes` together; what is told less of is told about as long of all modules.
// What functions and channels gave to runs takes its place from that. Variables that no module of the schedule knows
// get a track of their own, which is written in each basic period. A value that is larger than an eighth of `bytes` is
// on no track.
TapePlan plan_tape(std::span<const ModuleAccess> modules, std::span<const vars::DirectoryEntry> directory,
                   std::int64_t basic_period_ns, std::int64_t reach_ns, std::uint64_t bytes);

}  // namespace indurop::tape
