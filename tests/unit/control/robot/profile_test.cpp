// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lattice_reference.h"

namespace indurop::robot {
namespace {

constexpr double kProfileSlack = 1e-7;

struct Case {
  LineState from;
  double length = 0;
  double arrival = 0;
  LineLimits limits;
};

// States a motion within these limits can be in: what is left of the acceleration does not carry it beyond them.
Case random_case(std::mt19937& random) {
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  Case c;
  c.limits = {std::exp(any(-3, 2)), std::exp(any(-2, 3)), std::exp(any(-1, 6))};
  c.from.velocity = any(0, 1) < 0.3 ? 0 : any(0, c.limits.velocity);
  if (any(0, 1) < 0.5) {
    const double up = std::sqrt(2 * c.limits.jerk * (c.limits.velocity - c.from.velocity));
    const double down = std::sqrt(2 * c.limits.jerk * c.from.velocity);
    c.from.acceleration = any(-std::min(down, c.limits.acceleration), std::min(up, c.limits.acceleration));
  }
  c.arrival = any(0, 1) < 0.5 ? 0 : any(0, c.limits.velocity);
  c.length = std::exp(any(-6, 3));
  return c;
}

void expect_within_limits(const Profile& sut, const LineLimits& limits) {
  constexpr int kPlaces = 400;
  const double step = sut.duration() / kPlaces;
  LineState last = sut.at(0);
  for (int i = 1; i <= kPlaces; ++i) {
    const LineState now = sut.at(i * step);
    ASSERT_LE(now.velocity, limits.velocity * (1 + kProfileSlack) + kProfileSlack);
    ASSERT_GE(now.velocity, -kProfileSlack * (1 + limits.velocity));
    ASSERT_LE(std::abs(now.acceleration), limits.acceleration * (1 + kProfileSlack) + kProfileSlack);
    ASSERT_LE(std::abs(now.acceleration - last.acceleration), limits.jerk * step * (1 + 1e-6) + 1e-6);
    ASSERT_GE(now.position, last.position - kProfileSlack);
    last = now;
  }
}

TEST(Profile, Limits_are_never_exceeded_and_the_target_is_met) {
  std::mt19937 random(11);
  int short_ways = 0;
  for (int i = 0; i < 20000; ++i) {
    const Case c = random_case(random);
    const Profile sut = Profile::to_position(c.from, c.length, c.arrival, c.limits);
    expect_within_limits(sut, c.limits);
    if (sut.overshoots()) {
      ++short_ways;
      EXPECT_GT(ramp(c.from, 0, c.limits).distance, c.length);
      EXPECT_EQ(sut.end().velocity, 0);
      continue;
    }
    // Just before its end, where nothing has been set right yet.
    const LineState last = sut.at(sut.duration() * (1 - 1e-12));
    EXPECT_NEAR(last.position, c.length, 1e-6 * (1 + c.length));
    EXPECT_NEAR(last.acceleration, 0, 1e-3 * (1 + c.limits.acceleration));
    EXPECT_LE(sut.end().velocity, c.arrival + kProfileSlack);
  }
  EXPECT_GT(short_ways, 100);
  EXPECT_LT(short_ways, 15000);
}

// From rest to rest the shortest time has a closed form in each of its four cases; nothing may be slower.
double shortest_time(double length, const LineLimits& l) {
  const double v = l.velocity;
  const double a = l.acceleration;
  const double j = l.jerk;
  if (v * j >= a * a) {
    if (length >= v * v / a + v * a / j) {
      return length / v + v / a + a / j;
    }
    if (length >= 2 * a * a * a / (j * j)) {
      return a / j + std::sqrt(a * a / (j * j) + 4 * length / a);
    }
    return 4 * std::cbrt(length / (2 * j));
  }
  return length >= 2 * v * std::sqrt(v / j) ? length / v + 2 * std::sqrt(v / j) : 4 * std::cbrt(length / (2 * j));
}

TEST(Profile, From_rest_to_rest_in_the_shortest_time) {
  std::mt19937 random(12);
  for (int i = 0; i < 20000; ++i) {
    Case c = random_case(random);
    const Profile sut = Profile::to_position({}, c.length, 0, c.limits);
    const double expected = shortest_time(c.length, c.limits);
    EXPECT_NEAR(sut.duration(), expected, 1e-6 * expected);
  }
}

TEST(Profile, Planning_again_on_the_way_changes_nothing) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 5000; ++i) {
    Case c = random_case(random);
    const Profile first = Profile::to_position({}, c.length, 0, c.limits);
    const double when = part(random) * first.duration();
    const Profile again = Profile::to_position(first.at(when), c.length, 0, c.limits);
    EXPECT_NEAR(when + again.duration(), first.duration(), 1e-4 * first.duration());
    EXPECT_NEAR(again.at(again.duration()).position, c.length, 1e-6 * (1 + c.length));
  }
}

// Any state within the limits, in either direction, and any target.
Case any_case(std::mt19937& random) {
  Case c = random_case(random);
  const auto one_of = [&](double value) { return random() % 2 == 0 ? value : -value; };
  const double sign = one_of(1);
  c.from.velocity *= sign;
  c.from.acceleration *= sign;
  c.from.position = one_of(1);
  c.length = one_of(c.length);
  return c;
}

// What rounding leaves of the way to the top speed is little speed, but its root in time.
TEST(Profile, Ends_where_it_says_also_from_nearly_the_top_speed) {
  std::mt19937 random(12);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 20000; ++i) {
    const LineLimits limits{any(0.05, 1), any(0.05, 4), any(1, 40)};
    const double rounding = std::pow(10, any(-17, -9));
    const LineState from{0, limits.velocity * (1 + any(-1, 1) * rounding), any(-1, 1) * rounding};
    const double length = any(0.001, 0.1);
    const Profile sut = Profile::to_position(from, length, limits.velocity, limits);
    ASSERT_NEAR(sut.at(sut.duration() * (1 - 1e-14)).position, length, 1e-13) << i;
  }
}

TEST(Profile, To_rest_from_any_state_within_the_limits) {
  std::mt19937 random(14);
  for (int i = 0; i < 20000; ++i) {
    const Case c = any_case(random);
    const double target = c.from.position + c.length;
    const Profile sut = Profile::to_rest(c.from, target, c.limits);
    constexpr int kPlaces = 200;
    const double step = sut.duration() / kPlaces;
    LineState last = sut.at(0);
    EXPECT_EQ(last.position, c.from.position);
    for (int k = 1; k <= kPlaces; ++k) {
      const LineState now = sut.at(k * step * (1 - 1e-12));
      ASSERT_LE(std::abs(now.velocity), c.limits.velocity * (1 + kProfileSlack) + kProfileSlack);
      ASSERT_LE(std::abs(now.acceleration), c.limits.acceleration * (1 + kProfileSlack) + kProfileSlack);
      ASSERT_LE(std::abs(now.acceleration - last.acceleration), c.limits.jerk * step * (1 + 1e-6) + 1e-6);
      last = now;
    }
    EXPECT_NEAR(last.position, target, 1e-6 * (1 + std::abs(c.length)));
    EXPECT_NEAR(last.velocity, 0, 1e-6 * (1 + c.limits.velocity));
    EXPECT_NEAR(last.acceleration, 0, 1e-3 * (1 + c.limits.acceleration));
  }
}

// The best way has nothing better in its rest.
TEST(Profile, To_rest_planned_again_on_the_way_changes_nothing) {
  std::mt19937 random(15);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 20000; ++i) {
    const Case c = any_case(random);
    const double target = c.from.position + c.length;
    const Profile first = Profile::to_rest(c.from, target, c.limits);
    const double when = part(random) * first.duration();
    const Profile again = Profile::to_rest(first.at(when), target, c.limits);
    EXPECT_NEAR(when + again.duration(), first.duration(), 1e-4 * first.duration()) << i;
  }
}

// Against all motions in steps of one second with whole jerks.
TEST(Profile, To_rest_in_the_least_time) {
  constexpr int kAcceleration = 8;
  constexpr int kSpeed = 160;
  const Lattice lattice(kAcceleration, kSpeed, 160);
  const LineLimits limits{kSpeed / 2.0, kAcceleration, 1};
  std::mt19937 random(16);
  const auto any = [&](int most) { return std::uniform_int_distribution<int>(-most, most)(random); };
  double ours = 0;
  double least = 0;
  for (int i = 0; i < 4000; ++i) {
    const int a = any(kAcceleration);
    const int v = any(kSpeed);
    const int place = any(i % 2 == 0 ? 20000 : 2000);
    const int steps = lattice.steps_to(a, v, place);
    if (steps < 0) {
      continue;  // this speed cannot be kept below its limit, or it is too far
    }
    const double taken = Profile::to_rest({0, v / 2.0, 1.0 * a}, place / 6.0, limits).duration();
    EXPECT_LE(taken, steps + 1e-4) << a << " " << v << " " << place;
    EXPECT_GE(taken, steps - 4) << a << " " << v << " " << place;
    ours += taken;
    least += steps;
  }
  EXPECT_GT(ours, 0.97 * least);
}

TEST(Profile, To_a_velocity_and_on) {
  const LineLimits limits{2, 5, 50};
  const Profile sut = Profile::to_velocity({1, 2, 0}, -1.5, limits);
  const LineState end = sut.at(sut.duration() + 1);
  EXPECT_DOUBLE_EQ(end.velocity, -1.5);
  EXPECT_DOUBLE_EQ(end.position, sut.at(sut.duration()).position - 1.5);
  EXPECT_EQ(Profile::to_velocity({}, 9, limits).end().velocity, 2);
}

TEST(Profile, An_acceleration_above_its_limit_is_taken_back) {
  const LineLimits limits{2, 1, 10};
  const Ramp sut = ramp({0, 0.5, 3}, 2, limits);
  EXPECT_LT(sut.phases[0].jerk, 0);
  EXPECT_NEAR(Profile::to_velocity({0, 0.5, 3}, 2, limits).end().velocity, 2, 1e-12);
}

}  // namespace
}  // namespace indurop::robot
