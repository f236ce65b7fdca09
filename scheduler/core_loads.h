// SPDX-License-Identifier: Apache-2.0
// The work of each core in each tick, and for how long that keeps it busy. The order of the work does not matter for
// this.

#pragma once

#include <cstdint>
#include <vector>

#include "scheduler/placement_parts.h"

namespace indurop::scheduler {

// Modules that are placed on a core together.
struct LoadUnit {
  Modules modules;
  int core = -1;            // core the modules are bound to
  std::int64_t shifts = 1;  // number of possible shifts: releases are moved by 0 to shifts - 1 ticks
  std::int64_t period = 0;  // shortest period, in ticks
  struct Piece {
    std::int64_t tick;
    std::int64_t ns;
  };
  std::vector<Piece> work;   // in one macro period
  std::int64_t weight = 0;   // sum of the work, in ns
  std::int64_t largest = 0;  // most work in one tick, in ns
};

class CoreLoads {
 public:
  CoreLoads(int cores, std::int64_t ticks, std::int64_t basic_ns, std::int64_t tick_cost_ns);

  void add(int core, const LoadUnit& unit, std::int64_t shift);
  void remove(int core, const LoadUnit& unit, std::int64_t shift);
  // Maximum time from the begin of a tick until nothing is left to do, in nanoseconds.
  [[nodiscard]] std::int64_t busiest(int core) const { return busiest_[index(core)]; }
  [[nodiscard]] std::int64_t busiest() const;
  // The same if `unit` (null: none) were added and `gone` removed.
  [[nodiscard]] std::int64_t busiest_with(int core, const LoadUnit* unit, std::int64_t shift,
                                          const LoadUnit* gone = nullptr, std::int64_t gone_shift = 0) const;
  [[nodiscard]] std::int64_t ticks() const noexcept { return ticks_; }

 private:
  static std::size_t index(int core) noexcept { return static_cast<std::size_t>(core); }
  void apply(std::vector<std::int64_t>& load, const LoadUnit& unit, std::int64_t shift, std::int64_t sign) const;
  [[nodiscard]] std::int64_t longest(const std::vector<std::int64_t>& load) const;

  std::int64_t ticks_;
  std::int64_t room_;  // ns available in a tick
  std::int64_t tick_cost_;
  std::vector<std::vector<std::int64_t>> loads_;  // by core, then tick
  std::vector<std::int64_t> busiest_;
  mutable std::vector<std::int64_t> tried_;
};

}  // namespace indurop::scheduler
