// SPDX-License-Identifier: Apache-2.0
// Which board counts if several deliver a variable (<standby>): the one that has served longest. A board that comes
// back does not take the lead again, so that outputs do not jump. All boards decide by this rule, each on its own.

#pragma once

#include <cstdint>

namespace indurop::mirror {

// `session`: number of a run of a board, the time of its start in ns since 1970 by its own clock. A board whose clock
// was not set when it started (no battery, network not there yet) believes in an early year; it would take the lead
// from a board that works, so it comes after all that know the time.
constexpr bool leads(std::uint64_t session, std::uint64_t other) noexcept {
  constexpr std::uint64_t kSetClock = 1'704'067'200'000'000'000;  // 2024: before this software
  const bool set = session >= kSetClock;
  const bool other_set = other >= kSetClock;
  return set == other_set ? session < other : set;
}

}  // namespace indurop::mirror
