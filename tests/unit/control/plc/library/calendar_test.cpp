// SPDX-License-Identifier: Apache-2.0
// Arithmetic of times and the Gregorian calendar over its whole range.

#include <gtest/gtest.h>
#include <indurop/plc/calendar.h>

#include <limits>
#include <string>

namespace indurop::iec {
namespace {

constexpr Place kCalendarPlace{"prog.st:12:5", "MAIN"};
constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

TEST(PlcTime, Sums_and_differences) {
  EXPECT_EQ(add(Time{kSecond}, Time{kMillisecond}), Time{1'001 * kMillisecond});
  EXPECT_EQ(sub(Time{kSecond}, Time{2 * kSecond}), Time{-kSecond});
  EXPECT_EQ(add(Time{kMax}, Time{1}), Time{kMin});
  EXPECT_EQ(neg(Time{5}), Time{-5});
  EXPECT_EQ(add(DateTime{kDay}, Time{kHour}), DateTime{kDay + kHour});
  EXPECT_EQ(sub(DateTime{kDay}, Time{kHour}), DateTime{23 * kHour});
  EXPECT_EQ(sub(DateTime{kDay}, DateTime{kHour}), Time{23 * kHour});
  EXPECT_EQ(sub(Date{kDay}, Date{3 * kDay}), Time{-2 * kDay});
  EXPECT_EQ(sub(TimeOfDay{kHour}, TimeOfDay{3 * kHour}), Time{-2 * kHour});
}

TEST(PlcTime, The_time_of_day_goes_around_at_midnight) {
  EXPECT_EQ(add(TimeOfDay{23 * kHour}, Time{2 * kHour}), TimeOfDay{kHour});
  EXPECT_EQ(sub(TimeOfDay{kHour}, Time{2 * kHour}), TimeOfDay{23 * kHour});
  EXPECT_EQ(add(TimeOfDay{1}, Time{10 * kDay}), TimeOfDay{1});
  EXPECT_EQ(sub(TimeOfDay{0}, Time{1}), TimeOfDay{kDay - 1});
}

TEST(PlcTime, Multiplied_and_divided_by_any_number) {
  EXPECT_EQ(mul(Time{kSecond}, std::int16_t{-3}), Time{-3 * kSecond});
  EXPECT_EQ(mul(Time{3}, 0.5F), Time{2});
  EXPECT_EQ(mul(Time{kMax}, 2.0), Time{kMax});
  EXPECT_EQ(mul(Time{kMax}, std::int8_t{2}), Time{-2});
  EXPECT_EQ(div(kCalendarPlace, Time{7}, std::int16_t{2}), Time{3});
  EXPECT_EQ(div(kCalendarPlace, Time{-7}, std::uint64_t{2}), Time{-3});
  EXPECT_EQ(div(kCalendarPlace, Time{-7}, ~std::uint64_t{0}), Time{0});
  EXPECT_EQ(div(kCalendarPlace, Time{kMin}, std::int8_t{-1}), Time{kMin});
  EXPECT_EQ(div(kCalendarPlace, Time{kMin}, std::uint64_t{1}), Time{kMin});
  EXPECT_EQ(div(kCalendarPlace, Time{kSecond}, 0.5), Time{2 * kSecond});
}

TEST(PlcTime, Divided_by_zero_is_a_fault) {
  EXPECT_THROW(div(kCalendarPlace, Time{1}, std::int16_t{0}), Fault);
  EXPECT_THROW(div(kCalendarPlace, Time{1}, std::uint64_t{0}), Fault);
  EXPECT_THROW(div(kCalendarPlace, Time{1}, 0.0F), Fault);
}

TEST(PlcCalendar, Known_days) {
  EXPECT_EQ(concat_date(1970, 1, 1), Date{0});
  EXPECT_EQ(concat_date(1969, 12, 31), Date{-kDay});
  EXPECT_EQ(concat_date(2000, 2, 29), Date{11'016 * kDay});
  EXPECT_EQ(concat_date(2024, 3, 1), Date{19'783 * kDay});
  EXPECT_EQ(concat_date(std::int16_t{2023}, std::int16_t{2}, std::int16_t{29}), concat_date(2023, 3, 1));
  EXPECT_EQ(concat_date(2023, 13, 1), concat_date(2024, 1, 1));
  EXPECT_EQ(concat_date(2023, 0, 1), concat_date(2022, 12, 1));
}

TEST(PlcCalendar, Every_day_of_a_thousand_years_follows_the_one_before) {
  detail::Civil before = detail::civil_of(-200'000);
  for (std::int64_t day = -199'999; day < 165'000; ++day) {
    const detail::Civil civil = detail::civil_of(day);
    const bool next_day = civil.year == before.year && civil.month == before.month && civil.day == before.day + 1;
    const bool next_month = civil.year == before.year && civil.month == before.month + 1 && civil.day == 1;
    const bool next_year = civil.year == before.year + 1 && civil.month == 1 && civil.day == 1 && before.month == 12;
    ASSERT_TRUE(next_day || next_month || next_year) << day;
    ASSERT_TRUE(next_day || before.day >= 28) << day;
    ASSERT_EQ(detail::days_of(civil.year, civil.month, civil.day), day);
    before = civil;
  }
}

TEST(PlcCalendar, A_date_beyond_the_range_is_its_nearest_end) {
  EXPECT_EQ(concat_date(9999, 1, 1), concat_date(2262, 4, 11));
  EXPECT_EQ(concat_date(1, 1, 1), concat_date(1677, 9, 22));
  EXPECT_EQ(to<Date>(DateTime{kMin}), concat_date(1677, 9, 22));
}

TEST(PlcCalendar, Date_and_time_of_day_are_put_together) {
  EXPECT_EQ(concat_date_tod(Date{kDay}, TimeOfDay{kHour}), DateTime{kDay + kHour});
  EXPECT_EQ(concat_tod(1, 2, 3, 4), TimeOfDay{kHour + 2 * kMinute + 3 * kSecond + 4 * kMillisecond});
  EXPECT_EQ(concat_tod(24, 0, 0, 0), TimeOfDay{0});
  EXPECT_EQ(concat_tod(0, 0, 0, -1), TimeOfDay{kDay - kMillisecond});
  EXPECT_EQ(concat_dt(1970, 1, 2, 0, 0, 1, 0), DateTime{kDay + kSecond});
}

TEST(PlcCalendar, Days_of_the_week_count_from_sunday) {
  EXPECT_EQ(day_of_week(concat_date(1970, 1, 1)), 4);
  EXPECT_EQ(day_of_week(concat_date(2024, 2, 29)), 4);
  EXPECT_EQ(day_of_week(concat_date(2024, 3, 3)), 0);
  EXPECT_EQ(day_of_week(concat_date(1969, 12, 28)), 0);
}

}  // namespace
}  // namespace indurop::iec
