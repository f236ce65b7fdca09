// SPDX-License-Identifier: Apache-2.0
// The two times: plain numbers underneath, but neither passes for the other.

#include "core/rt/clock.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <type_traits>

namespace indurop::rt {
namespace {

using std::chrono::nanoseconds;

static_assert(!std::is_convertible_v<MonoTime, WallTime> && !std::is_convertible_v<WallTime, MonoTime>);
static_assert(!std::is_constructible_v<MonoTime, WallTime> && !std::is_constructible_v<WallTime, MonoTime>);
static_assert(!std::is_convertible_v<std::int64_t, MonoTime> && !std::is_convertible_v<std::int64_t, WallTime>);
static_assert(!std::is_convertible_v<nanoseconds, MonoTime> && !std::is_convertible_v<nanoseconds, WallTime>);
static_assert(std::is_trivially_copyable_v<MonoTime> && sizeof(MonoTime) == sizeof(std::int64_t));
static_assert(std::is_trivially_copyable_v<WallTime> && sizeof(WallTime) == sizeof(std::int64_t));
static_assert(to_ns(mono_time(5) + nanoseconds{3}) == 8 && mono_time(9) - mono_time(4) == nanoseconds{5});
static_assert(to_ns(wall_time(5) - nanoseconds{3}) == 2 && wall_time(1) < wall_time(2));

template <class A, class B>
concept Subtractable = requires(A a, B b) {
  a - b;
};
static_assert(Subtractable<MonoTime, MonoTime> && !Subtractable<MonoTime, WallTime>);

TEST(Clock, Numbers_go_there_and_back) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> any(std::numeric_limits<std::int64_t>::min(),
                                                  std::numeric_limits<std::int64_t>::max());
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t ns = any(random);
    EXPECT_EQ(to_ns(mono_time(ns)), ns);
    EXPECT_EQ(to_ns(wall_time(ns)), ns);
  }
}

TEST(Clock, Reads_the_clock_it_is_named_after) {
  const std::int64_t mono = now_ns();
  const std::int64_t wall = wall_ns();
  const MonoTime between = MonoClock::now();
  EXPECT_GE(to_ns(between), mono);
  EXPECT_LE(to_ns(between), now_ns());
  EXPECT_LT(WallClock::now() - wall_time(wall), std::chrono::hours{1});
}

TEST(Clock, Sleeps_until_a_time_and_not_beyond_one_that_is_past) {
  const MonoTime deadline = MonoClock::now() + std::chrono::microseconds{50};
  sleep_until(deadline);
  EXPECT_GE(MonoClock::now(), deadline);
  sleep_until(mono_time(0));
}

}  // namespace
}  // namespace indurop::rt
