// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace indurop::robot {
namespace {

constexpr LineLimits kLimits{2, 8, 80};
constexpr double kPeriod = 0.001;

double run_until_done(AxisMotion& sut) {
  for (int i = 0; i < 100000 && !sut.done(); ++i) {
    sut.step(kPeriod);
  }
  return sut.state().position;
}

TEST(AxisMotion, Forwards_and_backwards) {
  AxisMotion sut;
  sut.reset({1, 0, 0});
  sut.move_to(3, kLimits);
  EXPECT_DOUBLE_EQ(run_until_done(sut), 3);
  sut.move_to(-1, kLimits);
  EXPECT_DOUBLE_EQ(run_until_done(sut), -1);
  EXPECT_TRUE(sut.at_rest());
}

TEST(AxisMotion, Turns_back_when_the_new_target_is_behind) {
  AxisMotion sut;
  sut.reset({0, 0, 0});
  sut.move_to(10, kLimits);
  for (int i = 0; i < 800; ++i) {
    sut.step(kPeriod);
  }
  const double turned_at = sut.state().position;
  sut.move_to(0.5, kLimits);
  double farthest = turned_at;
  while (!sut.done()) {
    sut.step(kPeriod);
    farthest = std::max(farthest, sut.state().position);
  }
  EXPECT_GT(farthest, turned_at);
  EXPECT_DOUBLE_EQ(sut.state().position, 0.5);
}

TEST(AxisMotion, Velocity_until_stopped) {
  AxisMotion sut;
  sut.reset({0, 0, 0});
  sut.move_with(-1, kLimits);
  run_until_done(sut);
  EXPECT_DOUBLE_EQ(sut.state().velocity, -1);
  EXPECT_FALSE(sut.at_rest());
  sut.stop(kLimits);
  run_until_done(sut);
  EXPECT_TRUE(sut.at_rest());
}

TEST(AxisMotion, Commands_at_any_instant_keep_the_limits) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> any(-1, 1);
  AxisMotion sut;
  sut.reset({0, 0, 0});
  LineState last;
  for (int i = 0; i < 200000; ++i) {
    if (random() % 150 == 0) {
      switch (random() % 3) {
        case 0:
          sut.move_to(5 * any(random), kLimits);
          break;
        case 1:
          sut.move_with(2 * any(random), kLimits);
          break;
        default:
          sut.stop(kLimits);
      }
    }
    sut.step(kPeriod);
    const LineState now = sut.state();
    ASSERT_LE(std::abs(now.velocity), kLimits.velocity + 1e-9);
    ASSERT_LE(std::abs(now.acceleration), kLimits.acceleration + 1e-9);
    ASSERT_LE(std::abs(now.acceleration - last.acceleration), kLimits.jerk * kPeriod + 1e-6) << i;
    ASSERT_NEAR(now.position - last.position, kPeriod * (now.velocity + last.velocity) / 2, 1e-6);
    last = now;
  }
}

// What is asked for in mid-move may be slower and softer than what the axis is doing.
TEST(AxisMotion, Any_limits_at_any_instant_keep_the_axis_own_limits_and_ends) {
  constexpr double kEnd = 3;
  std::mt19937 random(5);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  AxisMotion sut;
  sut.set_bounds(kLimits, -kEnd, kEnd);
  sut.reset({0, 0, 0});
  LineState last;
  const auto step = [&] {
    sut.step(kPeriod);
    const LineState now = sut.state();
    EXPECT_LE(std::abs(now.position), kEnd + 1e-9);
    EXPECT_LE(std::abs(now.velocity), kLimits.velocity + 1e-9);
    EXPECT_LE(std::abs(now.acceleration), kLimits.acceleration + 1e-9);
    EXPECT_LE(std::abs(now.acceleration - last.acceleration), kLimits.jerk * kPeriod + 1e-6);
    EXPECT_NEAR(now.position - last.position, kPeriod * (now.velocity + last.velocity) / 2, 1e-6);
    last = now;
  };
  for (int i = 0; i < 200000 && !HasFailure(); ++i) {
    const auto some = [&](double most) { return most * std::pow(10, in(-2, 0)); };
    if (i % 2000 == 1999) {
      const double target = in(-kEnd, kEnd);
      sut.set_override(1);
      sut.move_to(target, kLimits);
      for (int k = 0; k < 20000 && !sut.done() && !HasFailure(); ++k) {
        step();
      }
      EXPECT_DOUBLE_EQ(sut.state().position, target);
    } else if (random() % 150 == 0) {
      const LineLimits limits{some(kLimits.velocity), some(kLimits.acceleration), some(kLimits.jerk)};
      if (random() % 4 > 0) {
        sut.move_to(in(-kEnd, kEnd), limits, {limits.velocity, some(kLimits.acceleration), limits.jerk});
      } else {
        sut.stop(limits);
      }
    } else if (random() % 300 == 0) {
      sut.set_override(in(0, 1));
    }
    step();
  }
}

TEST(AxisMotion, An_override_at_any_instant_keeps_limits_and_target) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    AxisMotion sut;
    sut.reset({0, 0, 0});
    sut.move_to(round % 2 == 0 ? 3 : -3, kLimits);
    LineState last;
    for (int i = 0; i < 6000 && !sut.done(); ++i) {
      if (random() % 80 == 0) {
        sut.set_override(i > 4000 ? 1 : static_cast<double>(random() % 5) / 4);
      }
      sut.step(kPeriod);
      const double v = (sut.state().position - last.position) / kPeriod;
      const double a = (v - last.velocity) / kPeriod;
      ASSERT_LT(std::abs(v), 2.001);
      ASSERT_LT(std::abs(a), 8.01);
      ASSERT_LT(std::abs(a - last.acceleration), 80.1 * kPeriod);
      ASSERT_LT(std::abs(sut.state().position), 3 + 1e-9);  // never beyond, to turn back
      last = {sut.state().position, v, a};
    }
    ASSERT_TRUE(sut.at_rest());
    ASSERT_DOUBLE_EQ(std::abs(sut.state().position), 3);
  }
}

}  // namespace
}  // namespace indurop::robot
