// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/pace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace indurop::robot {
namespace {

constexpr double kSlack = 1 + 1e-6;
const PaceLimits kLimits{4, 10, 40};

TEST(Pace, Is_limited_by_what_the_timing_leaves) {
  EXPECT_NEAR(kLimits.at(1).acceleration, std::min(0.05 * 4, 0.05 * 10 / 3), 1e-12);
  EXPECT_NEAR(kLimits.at(1).jerk, 0.05 * 40, 1e-12);
  EXPECT_NEAR(kLimits.at(0).acceleration, 4, 1e-12);
  EXPECT_NEAR(kLimits.at(0).jerk, 20, 1e-12);
}

TEST(Pace, Gets_to_rest_and_back_in_time) {
  for (const double period : {0.001, 0.004, 0.01}) {
    PaceChange sut;
    LineState now{0, 1, 0};
    double time = 0;
    for (; now.velocity > 0 && time < 10; time += period) {
      now = sut.next(now, 0, period, kLimits).at(period);
    }
    EXPECT_LT(time, 1.1);
    EXPECT_EQ(now.velocity, 0);
    EXPECT_EQ(now.acceleration, 0);
    for (time = 0; now.velocity < 1 && time < 10; time += period) {
      now = sut.next(now, 1, period, kLimits).at(period);
    }
    EXPECT_LT(time, 2);
    EXPECT_EQ(now.velocity, 1);
  }
}

TEST(Pace, Requests_at_any_instant_keep_the_limits) {
  std::mt19937 random(4);
  const auto any = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int round = 0; round < 300; ++round) {
    const double period = round % 3 == 0 ? 0.001 : round % 3 == 1 ? 0.004 : 0.01;
    PaceChange sut;
    LineState now{0, any(0, 1), 0};
    double wanted = now.velocity;
    for (int i = 0; i < 2000; ++i) {
      if (random() % 60 == 0) {
        wanted = random() % 3 == 0 ? 0 : random() % 3 == 0 ? 1 : any(0, 1);
      }
      const Profile plan = sut.next(now, wanted, period, kLimits);
      for (int k = 1; k <= 4; ++k) {
        const LineState there = plan.at(period * k / 4);
        const LineLimits most = kLimits.at(there.velocity);
        const double jerk = (there.acceleration - now.acceleration) / (period / 4);
        ASSERT_LE(there.velocity, 1 + 1e-6);
        ASSERT_GE(there.velocity, -1e-9);
        ASSERT_LE(std::abs(there.acceleration), most.acceleration * kSlack + 1e-6) << round << " " << i;
        ASSERT_LE(std::abs(jerk), kLimits.at(std::min(there.velocity, now.velocity)).jerk * kSlack + 1e-3) << round;
        now = there;
      }
    }
  }
}

}  // namespace
}  // namespace indurop::robot
