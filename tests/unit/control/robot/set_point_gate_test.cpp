// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/set_point_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace indurop::robot {
namespace {

constexpr LineLimits kGateLimits{3, 12, 120};
constexpr double kNoise = 5e-11;  // rad, what rounding may move a set point by

// Set points of the fastest move there is between two places, then at rest.
std::vector<double> move(double from, double to, double period, const LineLimits& limits) {
  const Profile plan = Profile::to_position({}, std::abs(to - from), 0, limits);
  std::vector<double> out;
  for (double t = 0; t < plan.duration() + 4 * period; t += period) {
    out.push_back(from + std::copysign(plan.at(t).position, to - from));
  }
  return out;
}

TEST(Set_point_gate, Lets_the_fastest_moves_pass_from_end_to_end) {
  for (const double period : {0.001, 0.004, 0.01}) {
    for (const double from : {-2.0, 1.9, 2.0}) {
      for (const double to : {-2.0, -1.99, 0.3, 2.0}) {
        SetPointGate sut({-2, 2}, kGateLimits, period);
        sut.stand(from);
        for (const double point : move(from, to, period, kGateLimits)) {
          ASSERT_EQ(sut.check(point, 1), ErrorCode::Ok) << from << " to " << to << " at " << point << ", " << period;
          sut.pass(point, 1);
        }
      }
    }
  }
}

// Near a singular position the inverse kinematics round more than plans leave.
TEST(Set_point_gate, Is_not_disturbed_by_rounding) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-kNoise, kNoise);
  for (const double period : {0.0001, 0.00025, 0.001, 0.01}) {
    SetPointGate sut({-2, 2}, kGateLimits, period);
    sut.stand(-1.5);
    for (const double exact : move(-1.5, 1.5, period, kGateLimits)) {
      const double point = exact + noise(random);
      ASSERT_EQ(sut.check(point, 1), ErrorCode::Ok) << point << ", period " << period;
      sut.pass(point, 1);
    }
  }
}

// What hides behind rounding adds up.
TEST(Set_point_gate, Refuses_a_jerk_a_hundredth_too_large) {
  const double period = 0.0001;
  SetPointGate sut({-2, 2}, kGateLimits, period);
  sut.stand(0);
  LineState state;
  while (state.acceleration < kGateLimits.acceleration / 2) {
    state.acceleration += 1.01 * kGateLimits.jerk * period;
    state.velocity += state.acceleration * period;
    state.position += state.velocity * period;
    if (sut.check(state.position, 1) != ErrorCode::Ok) {
      break;
    }
    sut.pass(state.position, 1);
  }
  EXPECT_EQ(sut.check(state.position, 1), ErrorCode::Jerk);
  EXPECT_LT(state.acceleration, kGateLimits.acceleration / 2);
}

TEST(Set_point_gate, Names_the_limit_that_is_broken) {
  SetPointGate sut({-2, 2}, kGateLimits, 0.001);
  sut.stand(0);
  EXPECT_EQ(sut.check(std::nan(""), 1), ErrorCode::Value);
  EXPECT_EQ(sut.check(std::numeric_limits<double>::infinity(), 1), ErrorCode::Value);
  EXPECT_EQ(sut.check(2.1, 1), ErrorCode::JointLimit);
  EXPECT_EQ(sut.check(0.0031, 1), ErrorCode::Speed);
  EXPECT_EQ(sut.check(0.000013, 1), ErrorCode::Acceleration);
  EXPECT_EQ(sut.check(0.000001, 1), ErrorCode::Jerk);
  EXPECT_EQ(sut.check(0, 1), ErrorCode::Ok);
}

TEST(Set_point_gate, What_stands_beyond_its_end_may_only_come_back) {
  SetPointGate sut({-2, 2}, kGateLimits, 0.001);
  sut.stand(2.5);
  EXPECT_EQ(sut.check(2.5, 1), ErrorCode::Ok);
  EXPECT_EQ(sut.check(2.5 + 1e-9, 1), ErrorCode::JointLimit);
  for (const double point : move(2.5, 1.5, 0.001, kGateLimits)) {
    ASSERT_EQ(sut.check(point, 1), ErrorCode::Ok) << point;
    sut.pass(point, 1);
  }
  sut.stand(1.9);
  EXPECT_EQ(sut.check(2.1, 1), ErrorCode::JointLimit) << "it is inside again";
}

TEST(Set_point_gate, A_harder_stop_has_harder_limits) {
  SetPointGate sut({-2, 2}, kGateLimits, 0.01);
  sut.stand(0);
  const double point = 1.2 * kGateLimits.jerk * 1e-6;
  EXPECT_EQ(sut.check(point, 1), ErrorCode::Jerk);
  EXPECT_EQ(sut.check(point, 1.5), ErrorCode::Ok);
}

TEST(Set_point_gate, Refuses_what_could_not_come_to_rest_before_the_end) {
  const double period = 0.004;
  SetPointGate sut({-2, 2}, kGateLimits, period);
  sut.stand(-2);
  // On to a place beyond the end: refused long before it.
  double last = -2;
  ErrorCode code = ErrorCode::Ok;
  for (const double point : move(-2, 5, period, kGateLimits)) {
    code = sut.check(point, 1);
    if (code != ErrorCode::Ok) {
      break;
    }
    sut.pass(point, 1);
    last = point;
  }
  EXPECT_EQ(code, ErrorCode::JointLimit);
  EXPECT_LT(last, 1.7);
  while (!sut.at_rest()) {
    sut.brake(1);
    ASSERT_LE(sut.state().position, 2 + 1e-9);
  }
  EXPECT_GT(sut.state().position, 1.97);  // and not earlier than it has to
}

// Whatever passes, all differences keep to the limits; braking does too, and ends at rest within the range.
TEST(Set_point_gate, Whatever_comes_and_whenever_it_brakes_no_limit_is_broken) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (int round = 0; round < 3000; ++round) {
    const double period = round % 3 == 0 ? 0.001 : round % 3 == 1 ? 0.004 : 0.01;
    const LineLimits limits{0.5 + 5 * part(random), 2 + 30 * part(random), 20 + 300 * part(random)};
    SetPointGate sut({-1, 1}, limits, period);
    const double start = 2 * part(random) - 1;
    sut.stand(start);
    double p0 = start;
    double v0 = 0;
    double a0 = 0;
    const auto look = [&](const char* what) {
      const double p = sut.state().position;
      const double v = (p - p0) / period;
      const double a = (v - v0) / period;
      const double j = (a - a0) / period;
      ASSERT_LE(std::abs(p), 1 + 1e-8) << what << " in round " << round;
      const double noise = 8 * kNoise / std::pow(period, 3);
      ASSERT_LE(std::abs(v), limits.velocity * 1.0002) << what << " in round " << round;
      ASSERT_LE(std::abs(a), limits.acceleration * 1.0002) << what << " in round " << round;
      ASSERT_LE(std::abs(j), limits.jerk * 1.0003 + noise) << what << " in round " << round;
      p0 = p, v0 = v, a0 = a;
    };
    // A chain of attempts that differ a little from going on as before: some pass.
    const int attempts = static_cast<int>(400 * part(random));
    for (int i = 0; i < attempts; ++i) {
      const double a = sut.state().acceleration + (2.4 * part(random) - 1.2) * limits.jerk * period;
      const double point = sut.state().position + period * (sut.state().velocity + period * a);
      if (sut.check(point, 1) == ErrorCode::Ok) {
        sut.pass(point, 1);
      } else {
        sut.brake(1);
      }
      look("moving");
      if (HasFatalFailure()) {
        return;
      }
    }
    int periods = 0;
    while (!sut.at_rest()) {
      sut.brake(1);
      look("braking");
      if (HasFatalFailure()) {
        return;
      }
      ASSERT_LT(++periods, 20000);
    }
  }
}

// As quick as a plan in continuous time, up to two periods.
TEST(Set_point_gate, Brakes_as_fast_as_can_be) {
  const double period = 0.001;
  SetPointGate sut({-100, 100}, kGateLimits, period);
  sut.stand(0);
  for (const double point : move(0, 3, period, kGateLimits)) {
    sut.pass(point, 1);
    if (sut.state().velocity > 2.9) {
      break;
    }
  }
  const LineState now = sut.state();
  int periods = 0;
  for (; !sut.at_rest(); ++periods) {
    sut.brake(1);
  }
  EXPECT_LE(periods, ramp(now, 0, kGateLimits).duration() / period + 3);
}

}  // namespace
}  // namespace indurop::robot
