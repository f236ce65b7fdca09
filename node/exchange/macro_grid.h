// SPDX-License-Identifier: Apache-2.0
// In which ticks macro periods begin. Those of a schedule that a node started with begin with tick 0; those of one that
// followed begin when they would after a restart: with those of the other boards of the plant. Pure arithmetic.

#pragma once

#include <cstdint>
#include <optional>

namespace indurop::node {

// The ticks whose number leaves `begin` when divided by `ticks`.
struct MacroGrid {
  std::uint64_t ticks = 1;
  std::uint64_t begin = 0;
  bool operator==(const MacroGrid&) const = default;
};

// Returns the grid of a schedule with a macro period of `ticks` that follows one with the grid `before`. Modules whose
// period and offset stay keep their ticks. `epoch_wall_ns`: wall time of tick 0, by whose multiples the boards of a
// plant begin; none: no plant.
MacroGrid following_grid(const MacroGrid& before, std::uint64_t ticks, std::int64_t basic_period_ns,
                         std::optional<std::int64_t> epoch_wall_ns);

// Returns the ticks in which macro periods of both begin, as following_grid() made one from the other. Nothing is
// waited for longer than a second: if they meet too seldom it is `before`, else every tick.
MacroGrid common_grid(const MacroGrid& before, const MacroGrid& next, std::int64_t basic_period_ns);

// The first tick of the grid that is not before `tick`.
std::uint64_t next_in(const MacroGrid& grid, std::uint64_t tick) noexcept;

}  // namespace indurop::node
