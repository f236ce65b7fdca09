// SPDX-License-Identifier: Apache-2.0
// Which module goes to which core. That it is as good as can be is shown by placement_solver.py.
#include "scheduler/placement.h"

#include <gmock/gmock.h>

#include <random>

namespace indurop::scheduler {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::ElementsAre;

Placeable module(std::int64_t period_ms, std::int64_t execution_us, std::vector<std::uint32_t> shares = {},
                 std::int64_t deadline_us = 0) {
  Placeable placed;
  placed.period = milliseconds(period_ms);
  placed.execution = microseconds(execution_us);
  placed.deadline = deadline_us > 0 ? Nanos(microseconds(deadline_us)) : placed.period;
  placed.shares = std::move(shares);
  return placed;
}

PlacementProblem problem(std::vector<Placeable> modules, int cores, bool split = false) {
  return {std::move(modules), cores, milliseconds(1), {}, split};
}

TEST(Placement, Spreads_modules_that_share_nothing) {
  const Placement sut = place(problem({module(1, 300), module(1, 200), module(1, 500)}, 2));
  EXPECT_TRUE(sut.holds);
  EXPECT_EQ(sut.busiest, microseconds(500));
  EXPECT_EQ(sut.core[0], sut.core[1]);
  EXPECT_NE(sut.core[0], sut.core[2]);
  EXPECT_THAT(sut.order, ElementsAre(0, 1, 2));
}

TEST(Placement, Keeps_together_what_shares_data_directly_or_through_others) {
  const Placement sut = place(problem({module(1, 300), module(1, 300, {0}), module(1, 300, {1}), module(1, 1)}, 4));
  EXPECT_EQ(sut.core[0], sut.core[1]);
  EXPECT_EQ(sut.core[0], sut.core[2]);
  EXPECT_NE(sut.core[0], sut.core[3]);
  EXPECT_EQ(sut.busiest, microseconds(900));
}

TEST(Placement, Splits_it_on_request) {
  // 0 gives to 1 and 2, which give to 3.
  const Placement sut =
      place(problem({module(1, 100), module(1, 300, {0}), module(1, 300, {0}), module(1, 100, {1, 2})}, 2, true));
  EXPECT_TRUE(sut.holds);
  EXPECT_EQ(sut.busiest, microseconds(500));
  EXPECT_NE(sut.core[1], sut.core[2]);
}

TEST(Placement, Counts_what_waiting_for_another_core_costs) {
  PlacementProblem sut = problem({module(1, 10), module(1, 12, {0}), module(1, 11, {0})}, 2, true);
  sut.cost.wake = microseconds(30);
  EXPECT_EQ(place(sut).busiest, microseconds(33)) << "one after the other on one core is quicker";
}

TEST(Placement, Leaves_modules_where_they_are_bound_to) {
  PlacementProblem sut = problem({module(1, 300), module(1, 300), module(1, 100)}, 2);
  sut.modules[0].core = sut.modules[1].core = 1;
  EXPECT_THAT(place(sut).core, ElementsAre(1, 1, 0));
}

TEST(Placement, Changes_the_order_only_if_it_does_not_hold_otherwise) {
  EXPECT_THAT(place(problem({module(1, 300), module(1, 200, {}, 500)}, 1)).order, ElementsAre(0, 1));
  const Placement sut = place(problem({module(1, 300), module(1, 200, {}, 400)}, 1));
  EXPECT_TRUE(sut.holds);
  EXPECT_THAT(sut.order, ElementsAre(1, 0));
  EXPECT_FALSE(place(problem({module(1, 300), module(1, 200, {0}, 400)}, 1)).holds) << "data keeps the order";
}

TEST(Placement, Moves_releases_only_if_it_does_not_hold_otherwise) {
  EXPECT_THAT(place(problem({module(2, 400), module(2, 500)}, 1)).offset, ElementsAre(Nanos(0), Nanos(0)));
  const Placement sut = place(problem({module(2, 600, {}, 800), module(2, 700, {}, 800)}, 1));
  EXPECT_TRUE(sut.holds);
  EXPECT_THAT(sut.offset, testing::UnorderedElementsAre(Nanos(0), Nanos(milliseconds(1))));
}

TEST(Placement, Says_when_it_does_not_hold) {
  EXPECT_FALSE(place(problem({module(1, 600), module(1, 600), module(1, 600)}, 2)).holds);
}

TEST(Placement, Finds_256_modules_on_64_cores_close_to_what_is_possible) {
  std::mt19937 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
  PlacementProblem sut = problem({}, 64);
  std::int64_t all = 0;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const std::int64_t execution = std::uniform_int_distribution(20, 240)(random);
    all += execution;
    sut.modules.push_back(module(1, execution));
  }
  const Placement found = place(sut);
  EXPECT_TRUE(found.holds);
  EXPECT_LT(found.busiest, microseconds(all / 64 * 105 / 100));
}

PlacementProblem many_periods(int cores, bool split, int longest_us) {
  std::mt19937 random(8);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
  const auto pick = [&random](int least, int most) { return std::uniform_int_distribution(least, most)(random); };
  PlacementProblem sut = problem({}, cores, split);
  for (std::uint32_t i = 0; i < 256; ++i) {
    const std::vector<std::int64_t> periods{1, 2, 5, 10, 20, 50, 100, 1000};
    sut.modules.push_back(module(periods[static_cast<std::size_t>(pick(0, 7))], pick(5, longest_us)));
    if (i % 4 != 0) {
      sut.modules.back().shares.push_back(i - 1);
    }
  }
  return sut;
}

TEST(Placement, Finds_256_modules_of_many_periods) {
  for (const bool split : {false, true}) {
    EXPECT_TRUE(place(many_periods(8, split, 60)).holds);
  }
}

TEST(Placement, Gives_up_on_256_modules_that_are_too_much) {
  for (const int cores : {1, 8, 64}) {
    EXPECT_FALSE(place(many_periods(cores, true, 1100)).holds);
  }
}

}  // namespace
}  // namespace indurop::scheduler
