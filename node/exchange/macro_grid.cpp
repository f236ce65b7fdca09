// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/macro_grid.h"

#include <numeric>

#include "core/rt/clock.h"

namespace indurop::node {
namespace {

std::int64_t remainder_of(std::int64_t value, std::int64_t divisor) noexcept {
  return (value % divisor + divisor) % divisor;
}

bool is_waited_for(std::uint64_t ticks, std::int64_t basic_period_ns) noexcept {
  return ticks <= static_cast<std::uint64_t>(rt::kNanosPerSecond / basic_period_ns);
}

}  // namespace

MacroGrid following_grid(const MacroGrid& before, std::uint64_t ticks, std::int64_t basic_period_ns,
                         std::optional<std::int64_t> epoch_wall_ns) {
  const auto step = static_cast<std::int64_t>(std::gcd(before.ticks, ticks));  // of possible begins
  const std::int64_t first = remainder_of(static_cast<std::int64_t>(before.begin), step);
  if (!epoch_wall_ns) {
    return {ticks, static_cast<std::uint64_t>(first)};
  }
  const auto all = static_cast<std::int64_t>(ticks);
  const std::int64_t wanted_ns = remainder_of(-*epoch_wall_ns, all * basic_period_ns);
  const std::int64_t past_ns = wanted_ns - first * basic_period_ns + step * basic_period_ns / 2;  // nearest, rounded up
  const std::int64_t steps = (past_ns - remainder_of(past_ns, step * basic_period_ns)) / (step * basic_period_ns);
  return {ticks, static_cast<std::uint64_t>(remainder_of(first + steps * step, all))};
}

MacroGrid common_grid(const MacroGrid& before, const MacroGrid& next, std::int64_t basic_period_ns) {
  const std::uint64_t ticks = before.ticks / std::gcd(before.ticks, next.ticks) * next.ticks;
  if (is_waited_for(ticks, basic_period_ns)) {
    for (std::uint64_t begin = before.begin; begin < before.begin + ticks; begin += before.ticks) {
      if (begin % next.ticks == next.begin) {
        return {ticks, begin};
      }
    }
  }
  return is_waited_for(before.ticks, basic_period_ns) ? before : MacroGrid{};
}

std::uint64_t next_in(const MacroGrid& grid, std::uint64_t tick) noexcept {
  const std::uint64_t past = (tick + grid.ticks - grid.begin % grid.ticks) % grid.ticks;
  return past == 0 ? tick : tick + grid.ticks - past;
}

}  // namespace indurop::node
