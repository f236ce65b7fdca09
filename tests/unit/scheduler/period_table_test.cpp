// SPDX-License-Identifier: Apache-2.0
// Period table: the chapter's Table 3, arithmetic at its limits, and properties against brute force.

#include "scheduler/period_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace indurop::scheduler {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Nanos kLongest = Nanos::max();

PeriodicItem item(Nanos period, int priority, Nanos offset = Nanos::zero()) {
  return {period, offset, priority};
}

std::vector<std::vector<std::uint32_t>> items_of(const PeriodTable& table) {
  std::vector<std::vector<std::uint32_t>> all;
  for (const Slot& slot : table.slots) {
    all.push_back(slot.items);
  }
  return all;
}

TEST(PeriodTable, Figure_1_gives_table_3) {
  const std::vector<PeriodicItem> cntr{item(microseconds(500), 3), item(microseconds(100), 2),
                                       item(microseconds(100), 1), item(microseconds(500), 4)};
  auto sut = make_period_table(cntr);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->basic_period, microseconds(100));
  EXPECT_EQ(sut->macro_period, microseconds(500));
  EXPECT_EQ(sut->slot_count, 5U);
  EXPECT_THAT(items_of(*sut), ElementsAre(ElementsAre(2, 1, 0, 3), ElementsAre(2, 1), ElementsAre(2, 1),
                                          ElementsAre(2, 1), ElementsAre(2, 1)));
  EXPECT_EQ(sut->slots[4].time, microseconds(400));
}

TEST(PeriodTable, No_items_give_an_empty_table) {
  auto sut = make_period_table({});
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->basic_period, Nanos::zero());
  EXPECT_EQ(sut->slot_count, 0U);
  EXPECT_THAT(sut->slots, IsEmpty());
}

TEST(PeriodTable, Equal_priorities_keep_input_order) {
  const std::vector<PeriodicItem> items{item(milliseconds(1), 5), item(milliseconds(1), -5), item(milliseconds(1), 5),
                                        item(milliseconds(1), std::numeric_limits<int>::min())};
  EXPECT_THAT(make_period_table(items)->slots.at(0).items, ElementsAre(3, 1, 0, 2));
}

TEST(PeriodTable, Offsets_refine_the_basic_period) {
  const std::vector<PeriodicItem> items{item(milliseconds(1), 1), item(milliseconds(2), 2, microseconds(500))};
  auto sut = make_period_table(items);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->basic_period, microseconds(500));
  EXPECT_THAT(items_of(*sut), ElementsAre(ElementsAre(0), ElementsAre(1), ElementsAre(0), IsEmpty()));
}

TEST(PeriodTable, Refuses_what_is_no_period_or_offset) {
  for (const PeriodicItem& bad :
       {item(Nanos(0), 1), item(Nanos(-1), 1), item(Nanos::min(), 1), item(Nanos(10), 1, Nanos(-1)),
        item(Nanos(10), 1, Nanos(10)), item(Nanos(10), 1, kLongest)}) {
    auto sut = make_period_table(std::vector{bad});
    ASSERT_FALSE(sut.ok());
    EXPECT_EQ(sut.error().code, Errc::InvalidArgument);
  }
}

TEST(PeriodTable, Longest_period_is_accepted_and_a_longer_macro_period_is_an_error) {
  auto alone = make_period_table(std::vector{item(kLongest, 1)});
  ASSERT_TRUE(alone.ok());
  EXPECT_EQ(alone->macro_period, kLongest);
  EXPECT_EQ(alone->slot_count, 1U);

  auto sut = make_period_table(std::vector{item(kLongest, 1), item(kLongest - Nanos(1), 2)});
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().code, Errc::Overflow);
}

TEST(PeriodTable, Macro_period_beyond_the_limit_is_found_with_many_coprime_periods) {
  std::vector<PeriodicItem> items;
  int priority = 0;
  for (const int prime : {101, 103, 107, 109, 113, 127, 131, 137, 139}) {
    items.push_back(item(microseconds(prime), ++priority));
  }
  auto sut = make_period_table(items);
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().code, Errc::Overflow);
}

TEST(PeriodTable, Slots_are_filled_up_to_their_limit_only) {
  const std::vector<PeriodicItem> items{item(microseconds(997), 1), item(microseconds(1009), 2)};
  auto sut = make_period_table(items);
  ASSERT_TRUE(sut.ok());
  EXPECT_EQ(sut->slot_count, 997U * 1009U);
  EXPECT_EQ(sut->slots.size(), kMaxSlots);
  EXPECT_THAT(sut->slots[997 * 3].items, ElementsAre(0));
  EXPECT_THAT(sut->slots[1009 * 5].items, ElementsAre(1));
}

TEST(PeriodTable, Three_hundred_items_share_one_slot) {
  std::vector<PeriodicItem> items;
  for (int i = 0; i < 300; ++i) {
    items.push_back(item(milliseconds(1), 300 - i));
  }
  auto sut = make_period_table(items);
  ASSERT_TRUE(sut.ok());
  ASSERT_EQ(sut->slots.size(), 1U);
  ASSERT_EQ(sut->slots[0].items.size(), 300U);
  EXPECT_EQ(sut->slots[0].items.front(), 299U);
  EXPECT_EQ(sut->slots[0].items.back(), 0U);
}

TEST(PeriodTable, Agrees_with_brute_force) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> periods(1, 24);
  std::uniform_int_distribution<int> priorities(-3, 3);
  for (int round = 0; round < 300; ++round) {
    std::vector<PeriodicItem> items;
    const int count = 1 + round % 6;
    std::int64_t gcd = 0;
    std::int64_t lcm = 1;
    for (int i = 0; i < count; ++i) {
      const int period = periods(random);
      const int offset = round % 2 == 0 ? 0 : periods(random) % period;
      items.push_back(item(Nanos(period), priorities(random), Nanos(offset)));
      gcd = std::gcd(std::gcd(gcd, std::int64_t{period}), std::int64_t{offset});
      lcm = std::lcm(lcm, std::int64_t{period});
    }
    auto sut = make_period_table(items);
    ASSERT_TRUE(sut.ok());
    ASSERT_EQ(sut->basic_period.count(), gcd);
    ASSERT_EQ(sut->macro_period.count(), lcm);
    ASSERT_EQ(sut->slot_count, static_cast<std::uint64_t>(lcm / gcd));
    for (std::size_t s = 0; s < sut->slots.size(); ++s) {
      const std::int64_t time = static_cast<std::int64_t>(s) * gcd;
      std::vector<std::uint32_t> expected;
      for (const std::uint32_t i : sut->order) {
        if (time % items[i].period.count() == items[i].offset.count()) {
          expected.push_back(i);
        }
      }
      ASSERT_EQ(sut->slots[s].items, expected);
      ASSERT_EQ(sut->slots[s].time.count(), time);
    }
  }
}

TEST(PeriodTable, Released_items_are_those_of_the_slot_for_ever) {
  const std::vector<PeriodicItem> items{item(Nanos(6), 1), item(Nanos(4), 2, Nanos(2)), item(Nanos(10), 3, Nanos(4))};
  auto table = make_period_table(items);
  ASSERT_TRUE(table.ok());
  const std::uint64_t late = (std::numeric_limits<std::uint64_t>::max() / table->slot_count - 1) * table->slot_count;
  for (const std::uint64_t from : {std::uint64_t{0}, late}) {
    for (std::uint64_t slot = 0; slot < table->slot_count; ++slot) {
      std::vector<std::uint32_t> released;
      for (const std::uint32_t i : table->order) {
        if (is_released(items[i], table->basic_period, from + slot)) {
          released.push_back(i);
        }
      }
      EXPECT_EQ(released, table->slots[slot].items) << "slot " << slot;
    }
  }
}

std::int64_t gcd_of(const std::vector<Nanos>& periods) {
  std::int64_t gcd = 0;
  for (const Nanos period : periods) {
    gcd = std::gcd(gcd, period.count());
  }
  return gcd;
}

double change_of(const std::vector<Nanos>& from, const std::vector<Nanos>& to) {
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    sum += std::abs(static_cast<double>((to[i] - from[i]).count())) / static_cast<double>(from[i].count());
  }
  return sum;
}

TEST(AdjustPeriods, Leaves_periods_alone_that_work) {
  const std::vector<Nanos> periods{microseconds(100), microseconds(500), milliseconds(3)};
  EXPECT_EQ(adjust_periods(periods, microseconds(100)), periods);
  EXPECT_THAT(adjust_periods({}, microseconds(100)), IsEmpty());
}

TEST(AdjustPeriods, Rounds_the_one_that_does_not_fit) {
  const std::vector<Nanos> periods{microseconds(100), microseconds(151), milliseconds(1)};
  EXPECT_THAT(adjust_periods(periods, microseconds(50)),
              ElementsAre(microseconds(100), microseconds(150), milliseconds(1)));
}

TEST(AdjustPeriods, Proposes_periods_that_people_write) {
  const std::vector<Nanos> periods{Nanos(1'000'003), microseconds(500), milliseconds(2)};
  EXPECT_THAT(adjust_periods(periods, microseconds(50)),
              ElementsAre(milliseconds(1), microseconds(500), milliseconds(2)));
}

TEST(AdjustPeriods, Raises_periods_below_the_minimum) {
  EXPECT_THAT(adjust_periods(std::vector<Nanos>{Nanos(1), Nanos(7)}, microseconds(50)),
              ElementsAre(microseconds(50), microseconds(50)));
}

TEST(AdjustPeriods, Equally_near_solutions_give_the_longest_basic_period) {
  EXPECT_EQ(gcd_of(adjust_periods(std::vector<Nanos>{Nanos(100), Nanos(200)}, Nanos(10))), 100);
}

TEST(AdjustPeriods, Survives_extremes) {
  const std::vector<Nanos> wide{Nanos(1), kLongest, kLongest - Nanos(1), Nanos(3)};
  for (const Nanos minimum : {Nanos::min(), Nanos(0), Nanos(1), microseconds(50) + Nanos(0), kLongest}) {
    const auto sut = adjust_periods(wide, minimum);
    ASSERT_EQ(sut.size(), wide.size());
    for (const Nanos period : sut) {
      EXPECT_GT(period, Nanos::zero());
    }
    EXPECT_GE(gcd_of(sut), std::max<std::int64_t>(minimum.count(), 1));
  }
}

TEST(AdjustPeriods, Many_coprime_periods_are_adjusted_in_reasonable_effort) {
  std::vector<Nanos> periods;
  for (int i = 0; i < 300; ++i) {
    periods.emplace_back(100'003 + i * 7919);
  }
  const auto sut = adjust_periods(periods, microseconds(50));
  EXPECT_GE(gcd_of(sut), 50'000);
  EXPECT_LE(change_of(periods, sut), change_of(periods, std::vector<Nanos>(periods.size(), periods.front())));
}

// The best that any basic period can do, tried one by one.
double least_change(const std::vector<Nanos>& periods, std::int64_t minimum, std::int64_t longest) {
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t basic = minimum; basic <= longest; ++basic) {
    std::vector<Nanos> rounded;
    for (const Nanos period : periods) {
      const std::int64_t parts = std::max<std::int64_t>((period.count() + basic / 2) / basic, 1);
      const std::int64_t below = std::max<std::int64_t>(period.count() / basic, 1) * basic;
      const bool down = std::abs(below - period.count()) <= std::abs(parts * basic - period.count());
      rounded.emplace_back(down ? below : parts * basic);
    }
    least = std::min(least, change_of(periods, rounded));
  }
  return least;
}

TEST(AdjustPeriods, No_other_basic_period_changes_less) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> any(1, 400);
  for (int round = 0; round < 400; ++round) {
    std::vector<Nanos> periods;
    for (int i = 0; i < 1 + round % 5; ++i) {
      periods.emplace_back(any(random));
    }
    const std::int64_t minimum = 1 + any(random) % 60;
    const auto sut = adjust_periods(periods, Nanos(minimum));
    ASSERT_GE(gcd_of(sut), minimum);
    ASSERT_NEAR(change_of(periods, sut), least_change(periods, minimum, 500), 1e-9);
  }
}

}  // namespace
}  // namespace indurop::scheduler
