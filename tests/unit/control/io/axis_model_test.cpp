// SPDX-License-Identifier: Apache-2.0
// Step responses of the simulated axis against what the theory of a second-order system says, its limits, its encoder.
#include "control/io/axis_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace indurop::io {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Response {
  double settled_s = 0;  // within 2 % from then on
  double overshoot = 0;  // of the step
  double fastest = 0;    // rad/s
  bool limited = false;
};

Response step_of(AxisModel& sut, double size, double seconds) {
  Response response;
  const int steps = static_cast<int>(seconds / AxisModel::kStep);
  for (int i = 0; i < steps; ++i) {
    sut.drive({size, 0, true});
    response.overshoot = std::max(response.overshoot, sut.position() / size - 1);
    response.fastest = std::max(response.fastest, std::fabs(sut.velocity()));
    response.limited = response.limited || sut.limited();
    if (std::fabs(sut.position() - size) > 0.02 * std::fabs(size)) {
      response.settled_s = (i + 1) * AxisModel::kStep;
    }
  }
  return response;
}

TEST(AxisModel, A_small_step_is_critically_damped) {
  for (const double bandwidth : {5.0, 20.0, 80.0}) {
    config::IoAxis axis;
    axis.bandwidth = bandwidth;
    AxisModel sut(axis);
    const Response response = step_of(sut, 1e-4, 2);
    const double omega = 2 * std::numbers::pi * bandwidth;
    EXPECT_NEAR(response.settled_s * omega, 5.83, 0.4) << bandwidth << " Hz";  // 2 % of a double pole
    EXPECT_LT(response.overshoot, 0.01) << bandwidth << " Hz";
    EXPECT_FALSE(response.limited);
  }
}

TEST(AxisModel, Damping_costs_no_position) {
  config::IoAxis axis;
  axis.damping = 20;
  AxisModel sut(axis);
  step_of(sut, 0.01, 1);
  EXPECT_NEAR(sut.position(), 0.01, 1e-6);
}

// The loops are a spring: the position loop asks for pi f of velocity, the velocity loop gives 4 pi f of torque for it,
// and what damping will take.
TEST(AxisModel, A_load_makes_it_sag_like_a_spring_unless_the_torque_is_commanded) {
  config::IoAxis axis;
  AxisModel sut(axis);
  constexpr double kLoad = 40;
  const double omega = std::numbers::pi * axis.bandwidth;
  sut.carry(kLoad);
  for (int i = 0; i < 8000; ++i) {
    sut.drive({0, 0, true, 0});
  }
  EXPECT_NEAR(sut.position(), -kLoad / ((axis.inertia * 4 * omega + axis.damping) * omega), 1e-9);
  EXPECT_NEAR(sut.torque(), kLoad, 1e-6);
  for (int i = 0; i < 8000; ++i) {
    sut.drive({0, 0, true, kLoad});
  }
  EXPECT_NEAR(sut.position(), 0, 1e-9);
}

TEST(AxisModel, Its_brake_holds_what_it_carries) {
  config::IoAxis axis;
  AxisModel sut(axis);
  sut.carry(10 * axis.torque);
  for (int i = 0; i < 1000; ++i) {
    sut.brake();
  }
  EXPECT_EQ(sut.position(), 0);
  EXPECT_EQ(sut.velocity(), 0);
}

TEST(AxisModel, A_large_step_keeps_to_torque_and_speed) {
  config::IoAxis axis;
  axis.damping = 0;
  AxisModel sut(axis);
  const Response response = step_of(sut, 90 * kDegree, 0.3);
  EXPECT_TRUE(response.limited);
  EXPECT_LT(response.fastest, 180 * kDegree * 1.02);
  EXPECT_GT(response.fastest, 180 * kDegree * 0.98);
  AxisModel slow(axis);
  slow.drive({90 * kDegree, 0, true});
  EXPECT_NEAR(slow.velocity() / AxisModel::kStep, 200 / 0.5, 1e-6) << "largest torque on the inertia";
  EXPECT_EQ(slow.torque(), 200);
}

TEST(AxisModel, The_brake_stops_and_holds) {
  AxisModel sut(config::IoAxis{});
  for (int i = 0; i < 1000; ++i) {
    sut.drive({0, 100 * kDegree, false});
  }
  const double before = sut.position();
  for (int i = 0; i < 200; ++i) {
    sut.brake();
  }
  EXPECT_NEAR(sut.velocity(), 0, 1e-9);
  // v^2 / (2 a) = (1.745 rad/s)^2 / (2 * 400 rad/s2)
  EXPECT_NEAR(sut.position() - before, 0.0038, 0.0003);
}

// With lag the torque is the current of a winding: 1 - exp(-t / T) of what is demanded, whatever the step.
TEST(AxisModel, The_torque_follows_like_the_current_of_a_winding) {
  for (const double step : {AxisModel::kStep, 100e-6, 7e-6}) {
    config::IoAxis axis;
    axis.torque_bandwidth = 50;
    AxisModel sut(axis);
    sut.set_step(step);
    for (int i = 1; i < 100; ++i) {
      sut.push(2);
      EXPECT_NEAR(sut.torque(), 2 * (1 - std::exp(-i * step * 2 * std::numbers::pi * 50)), 1e-9);
    }
    sut.brake();
    EXPECT_EQ(sut.torque(), 0);
  }
}

TEST(AxisModel, Steps_of_any_length_go_the_same_way) {
  const auto way = [](double step, int steps) {
    AxisModel sut(config::IoAxis{});
    sut.set_step(step);
    for (int i = 0; i < steps; ++i) {
      sut.push(10);
    }
    return sut.position();
  };
  // t / b - J / b^2 (1 - exp(-b t / J)) of the torque, with inertia J and damping b
  const double exact = 10 * (0.1 - 0.5 * (1 - std::exp(-0.1 / 0.5)));
  EXPECT_NEAR(way(AxisModel::kStep, 800), exact, exact * 0.003);
  EXPECT_NEAR(way(100e-6, 1000), exact, exact * 0.003);
}

TEST(AxisModel, The_encoder_counts_whole_steps) {
  config::IoAxis axis;
  axis.counts = 360;
  axis.start = 12.4;
  EXPECT_EQ(AxisModel(axis).read_encoder(), 12);
  axis.start = -12.6;
  EXPECT_EQ(AxisModel(axis).read_encoder(), -13);
}

}  // namespace
}  // namespace indurop::io
