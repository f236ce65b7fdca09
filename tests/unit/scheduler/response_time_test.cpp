// SPDX-License-Identifier: Apache-2.0
// Against two oracles written another way: the equation of Joseph and Pandya (1986) where all are released at once, and
// a walk in microseconds with executions that vary, where they have offsets.
#include "scheduler/response_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

namespace indurop::scheduler {
namespace {

using std::chrono::microseconds;

constexpr Nanos kBasic = microseconds(100);

Demand demand(std::int64_t period_us, std::int64_t execution_us, std::int64_t offset_us = 0, bool own_thread = false) {
  return {microseconds(period_us), microseconds(offset_us), microseconds(execution_us), own_thread};
}

TEST(ResponseTime, Is_what_runs_before_and_oneself) {
  const std::vector<Demand> demands{demand(100, 20), demand(200, 50), demand(400, 60)};
  const WorstResponses found = worst_responses(demands, kBasic, {});
  // 60 begin after 70, go on for 30, and end behind the first one of the next tick.
  EXPECT_EQ(found.worst, (std::vector<Nanos>{microseconds(20), microseconds(70), microseconds(150)}));
}

TEST(ResponseTime, Counts_what_the_platform_takes) {
  const std::vector<Demand> demands{demand(100, 20), demand(200, 30, 0, true)};
  const WorstResponses found = worst_responses(demands, kBasic, {microseconds(10), microseconds(5)});
  EXPECT_EQ(found.worst, (std::vector<Nanos>{microseconds(30), microseconds(65)}));
}

TEST(ResponseTime, Says_what_is_never_done) {
  const std::vector<Demand> demands{demand(100, 60), demand(200, 90), demand(400, 1)};
  const WorstResponses found = worst_responses(demands, kBasic, {});
  EXPECT_EQ(found.worst[0], microseconds(60));
  EXPECT_EQ(found.worst[1], WorstResponses::kNotDone);
}

TEST(ResponseTime, Offsets_keep_modules_apart) {
  EXPECT_EQ(worst_responses(std::vector{demand(200, 80), demand(200, 80)}, kBasic, {}).worst[1], microseconds(160));
  EXPECT_EQ(worst_responses(std::vector{demand(200, 80), demand(200, 80, 100)}, kBasic, {}).worst[1], microseconds(80));
}

TEST(ResponseTime, Too_many_ticks_are_taken_as_if_all_were_released_at_once) {
  std::vector<Demand> demands;
  for (const std::int64_t prime : {101, 103, 107, 109, 113}) {
    demands.push_back(demand(prime * 100, 10, 100));
  }
  const WorstResponses found = worst_responses(demands, kBasic, {});
  EXPECT_FALSE(found.with_offsets);
  EXPECT_EQ(found.worst.back(), microseconds(50));
}

Demand on(int core, Demand demand, std::vector<std::uint32_t> after = {}) {
  demand.core = core;
  demand.after = std::move(after);
  return demand;
}

TEST(ResponseTime, Who_waits_for_another_core_may_be_worse_off_at_a_later_release) {
  const std::vector<Demand> demands{on(0, demand(400, 130)), on(1, demand(300, 50)), on(1, demand(400, 20), {0})};
  // At 0 the last one begins at 130. At 800 the second one is released at 900, and it begins at 950.
  EXPECT_EQ(worst_responses(demands, kBasic, {}).worst[2], microseconds(170));
}

TEST(ResponseTime, Too_many_ticks_with_waits_between_cores_are_taken_as_if_all_were_on_one) {
  std::vector<Demand> demands;
  for (const std::int64_t prime : {101, 103, 107, 109, 113}) {
    demands.push_back(on(static_cast<int>(prime), demand(prime * 100, 10)));
  }
  EXPECT_EQ(worst_responses(demands, kBasic, {}).worst.back(), microseconds(10)) << "without waits";
  demands.back().after = {0};
  EXPECT_EQ(worst_responses(demands, kBasic, {}).worst.back(), microseconds(50));
}

struct Random {
  std::mt19937 engine{42};  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
  std::int64_t up_to(std::int64_t most) { return std::uniform_int_distribution<std::int64_t>(0, most)(engine); }
};

std::vector<Demand> random_demands(Random& random, bool offsets) {
  constexpr std::array<std::int64_t, 7> kPeriods{100, 200, 300, 400, 500, 600, 1200};
  std::vector<Demand> demands(static_cast<std::size_t>(1 + random.up_to(6)));
  for (Demand& one : demands) {
    const std::int64_t period = kPeriods[static_cast<std::size_t>(random.up_to(kPeriods.size() - 1))];
    const std::int64_t offset = offsets ? 100 * random.up_to(period / 100 - 1) : 0;
    one = demand(period, 1 + random.up_to(period / 4), offset, random.up_to(1) == 1);
  }
  return demands;
}

// The least fixed point of the time demanded by this and all before it; beyond the period it is not done.
Nanos by_equation(const std::vector<Demand>& demands, std::size_t last, const DispatchCost& cost) {
  const auto whole = [&](const Demand& one) { return one.execution + (one.own_thread ? cost.wake : Nanos{}); };
  const auto times = [](Nanos within, Nanos period) { return (within.count() + period.count() - 1) / period.count(); };
  Nanos response = whole(demands[last]);
  for (Nanos before{}; response != before && response <= demands[last].period;) {
    before = response;
    response = whole(demands[last]) + times(before, kBasic) * cost.tick;
    for (std::size_t i = 0; i < last; ++i) {
      response += times(before, demands[i].period) * whole(demands[i]);
    }
  }
  return response > demands[last].period ? WorstResponses::kNotDone : response;
}

TEST(ResponseTime, Equals_the_equation_where_all_are_released_at_once) {
  Random random;
  int done = 0;
  for (int set = 0; set < 5000; ++set) {
    const std::vector<Demand> demands = random_demands(random, false);
    const DispatchCost cost{microseconds(random.up_to(10)), microseconds(random.up_to(5))};
    const WorstResponses found = worst_responses(demands, kBasic, cost);
    for (std::size_t i = 0; i < demands.size(); ++i) {
      const Nanos expected = by_equation(demands, i, cost);
      ASSERT_EQ(found.worst[i], expected) << "set " << set << ", demand " << i;
      if (expected == WorstResponses::kNotDone) {
        break;  // what is skipped then is left out of the equation
      }
      ++done;
    }
  }
  EXPECT_GT(done, 5000);
}

// One microsecond after the other; each execution is as long as it may be, or shorter.
std::vector<std::int64_t> walked(const std::vector<Demand>& demands, Random& random, bool shorter) {
  const std::size_t count = demands.size();
  std::vector<std::int64_t> left(count);
  std::vector<std::int64_t> begin(count);
  std::vector<std::int64_t> worst(count);
  for (std::int64_t now = 0; now < 6000; ++now) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t since = now - demands[i].offset.count() / 1000;
      if (since >= 0 && since % (demands[i].period.count() / 1000) == 0) {
        const std::int64_t longest = demands[i].execution.count() / 1000;
        left[i] = shorter ? 1 + random.up_to(longest - 1) : longest;
        begin[i] = now;
      }
    }
    const auto running = std::find_if(left.begin(), left.end(), [](std::int64_t rest) { return rest > 0; });
    if (running != left.end() && --*running == 0) {
      const auto i = static_cast<std::size_t>(running - left.begin());
      worst[i] = std::max(worst[i], now + 1 - begin[i]);
    }
  }
  return worst;
}

TEST(ResponseTime, Is_never_below_what_a_walk_through_time_sees_and_reached_by_the_longest_executions) {
  Random random;
  int sets = 0;
  for (int set = 0; set < 600; ++set) {
    const std::vector<Demand> demands = random_demands(random, true);
    const WorstResponses found = worst_responses(demands, kBasic, {});
    ASSERT_TRUE(found.with_offsets);
    if (std::find(found.worst.begin(), found.worst.end(), WorstResponses::kNotDone) != found.worst.end()) {
      continue;
    }
    ++sets;
    const auto longest = walked(demands, random, false);
    const auto varied = walked(demands, random, true);
    for (std::size_t i = 0; i < demands.size(); ++i) {
      ASSERT_EQ(found.worst[i].count() / 1000, longest[i]) << "set " << set << ", demand " << i;
      ASSERT_LE(varied[i], longest[i]) << "set " << set << ", demand " << i;
    }
  }
  EXPECT_GT(sets, 100);
}

}  // namespace
}  // namespace indurop::scheduler
