// SPDX-License-Identifier: Apache-2.0
// Basic period (GCD), macro period (LCM) and the table of releases in each basic period (chapter, Table 3). Pure
// arithmetic: no clock, no threads.

#pragma once

#include <indurop/result.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace indurop::scheduler {

using Nanos = std::chrono::nanoseconds;

// The data of one periodic module that the table needs. Lowest priority value runs first; equal priorities keep input
// order.
struct PeriodicItem {
  Nanos period;
  Nanos offset;  // first release after tick 0; 0 <= offset < period
  int priority = 0;
};

struct Slot {
  Nanos time{};                      // since the start of the macro period
  std::vector<std::uint32_t> items;  // indices into the input, in execution order
};

struct PeriodTable {
  Nanos basic_period{};
  Nanos macro_period{};
  std::vector<std::uint32_t> order;  // all items by priority
  std::uint64_t slot_count = 0;      // macro / basic; `slots` is only filled up to kMaxSlots
  std::vector<Slot> slots;
};
inline constexpr std::uint64_t kMaxSlots = 100'000;

// Not real-time safe. Errors: InvalidArgument (a period <= 0, an offset outside [0, period)), Overflow (the macro
// period exceeds 2^63 ns). An empty input gives an empty table.
Result<PeriodTable> make_period_table(std::span<const PeriodicItem> items);

// Returns whether an item is released in basic period `tick`, counted from 0 without end. Real-time safe.
bool is_released(const PeriodicItem& item, Nanos basic_period, std::uint64_t tick) noexcept;

// Returns the nearest periods whose GCD is at least `minimum`, each changed as little as possible (rounded to a
// multiple of the best common basic period >= minimum). Same order as the input.
std::vector<Nanos> adjust_periods(std::span<const Nanos> periods, Nanos minimum);

}  // namespace indurop::scheduler
