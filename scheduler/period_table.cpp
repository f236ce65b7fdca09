// SPDX-License-Identifier: Apache-2.0
// GCD and LCM arithmetic of the period table, checked for overflow, and the search for periods that satisfy a minimum.

#include "scheduler/period_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "scheduler/execution_order.h"

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kLongest = std::numeric_limits<std::int64_t>::max();

// Effort of adjust_periods: candidates for the basic period, over all periods together.
constexpr std::size_t kMaxCandidates = 32'768;

// Returns the nearest positive multiple of `basic`; the shorter one if both are equally near or the longer one does not
// fit.
std::int64_t nearest_multiple(std::int64_t period, std::int64_t basic) {
  const std::int64_t rest = period % basic;
  if (period < basic) {
    return basic;
  }
  if (rest <= basic - rest || period > kLongest - (basic - rest)) {
    return period - rest;
  }
  return period + (basic - rest);
}

long double relative_change(std::span<const Nanos> periods, std::int64_t basic) {
  long double sum = 0;
  for (const Nanos period : periods) {
    const std::int64_t adjusted = nearest_multiple(period.count(), basic);
    sum += std::fabs(static_cast<long double>(adjusted) - static_cast<long double>(period.count())) /
           static_cast<long double>(period.count());
  }
  return sum;
}

// The total change, as a function of the basic period, has its minima where some period is a whole multiple of it.
std::vector<std::int64_t> basic_period_candidates(std::span<const Nanos> periods, std::int64_t minimum) {
  std::vector<std::int64_t> distinct;
  for (const Nanos period : periods) {
    distinct.push_back(period.count());
  }
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());

  std::vector<std::int64_t> candidates{minimum};
  const auto each = static_cast<std::int64_t>(std::max<std::size_t>(kMaxCandidates / distinct.size(), 1));
  for (const std::int64_t period : distinct) {
    for (std::int64_t parts = 1; parts <= each && period / parts >= minimum - 1; ++parts) {
      const std::int64_t below = period / parts;
      candidates.push_back(below);
      if (period % parts != 0) {
        candidates.push_back(below + 1);
      }
    }
  }
  std::erase_if(candidates, [minimum](std::int64_t basic) { return basic < minimum; });
  std::sort(candidates.begin(), candidates.end(), std::greater<>());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  return candidates;
}

// Returns a basic period that users would write, if it changes the periods by at most 0.05 % each more than `basic`: 1
// ms, not 1000.001 us.
std::int64_t round_basic_period(std::span<const Nanos> periods, std::int64_t basic, std::int64_t minimum) {
  constexpr std::array<std::int64_t, 13> kUnits{10'000'000, 5'000'000, 2'000'000, 1'000'000, 500'000, 200'000, 100'000,
                                                50'000,     20'000,    10'000,    5'000,     2'000,   1'000};
  constexpr long double kSlack = 0.0005L;
  const long double change = relative_change(periods, basic);
  if (change == 0 || basic > kLongest - kUnits.front()) {
    return basic;
  }
  const long double limit = change + kSlack * static_cast<long double>(periods.size());
  for (const std::int64_t unit : kUnits) {
    const std::int64_t round = (basic + unit / 2) / unit * unit;
    if (round >= std::max<std::int64_t>(minimum, 1) && relative_change(periods, round) <= limit) {
      return round;
    }
  }
  return basic;
}

void fill_slots(PeriodTable& table, std::span<const PeriodicItem> items) {
  const auto count = static_cast<std::size_t>(std::min(table.slot_count, kMaxSlots));
  table.slots.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    table.slots[i].time = table.basic_period * static_cast<std::int64_t>(i);
  }
  for (const std::uint32_t index : table.order) {
    const PeriodicItem& item = items[index];
    const auto step = static_cast<std::size_t>(item.period / table.basic_period);
    auto slot = static_cast<std::size_t>(item.offset / table.basic_period);
    while (slot < count) {
      table.slots[slot].items.push_back(index);
      slot = step > count - slot ? count : slot + step;
    }
  }
}

}  // namespace

Result<PeriodTable> make_period_table(std::span<const PeriodicItem> items) {
  PeriodTable table;
  if (items.empty()) {
    return table;
  }
  std::int64_t basic = 0;
  std::int64_t macro = 1;
  for (const PeriodicItem& item : items) {
    const std::int64_t period = item.period.count();
    if (period <= 0) {
      return Error{Errc::InvalidArgument, 0, "a period must be positive"};
    }
    if (item.offset < Nanos::zero() || item.offset >= item.period) {
      return Error{Errc::InvalidArgument, 0, "an offset must be at least 0 and below its period"};
    }
    basic = std::gcd(std::gcd(basic, period), item.offset.count());
    const std::int64_t factor = period / std::gcd(macro, period);
    if (macro > kLongest / factor) {
      return Error{Errc::Overflow, 0, "the macro period exceeds 2^63 ns"};
    }
    macro *= factor;
  }
  table.basic_period = Nanos{basic};
  table.macro_period = Nanos{macro};
  table.slot_count = static_cast<std::uint64_t>(macro / basic);  // NOLINT(*DivideZero): a divisor of positive periods

  table.order = execution_order(items.size(), [items](std::uint32_t i) { return items[i].priority; });
  fill_slots(table, items);
  return table;
}

bool is_released(const PeriodicItem& item, Nanos basic_period, std::uint64_t tick) noexcept {
  const auto ticks_per_period = static_cast<std::uint64_t>(item.period / basic_period);
  return tick % ticks_per_period == static_cast<std::uint64_t>(item.offset / basic_period);
}

std::vector<Nanos> adjust_periods(std::span<const Nanos> periods, Nanos minimum) {
  if (periods.empty()) {
    return {};
  }
  std::int64_t best = 1;
  long double least = std::numeric_limits<long double>::infinity();
  for (const std::int64_t basic : basic_period_candidates(periods, std::max<std::int64_t>(minimum.count(), 1))) {
    const long double change = relative_change(periods, basic);
    if (change < least) {  // candidates descend: of equally good ones the longest basic period wins
      least = change;
      best = basic;
    }
  }
  best = round_basic_period(periods, best, minimum.count());
  std::vector<Nanos> adjusted;
  adjusted.reserve(periods.size());
  for (const Nanos period : periods) {
    adjusted.emplace_back(nearest_multiple(period.count(), best));
  }
  return adjusted;
}

}  // namespace indurop::scheduler
