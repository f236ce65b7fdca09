// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/trajectory.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "control/robot/path/time_profile.h"

namespace indurop::ros {
namespace {

std::vector<AxisNow> two_axes() {
  AxisNow axis;
  axis.lower = -170;
  axis.upper = 170;
  axis.most_velocity = 100;
  axis.most_acceleration = 400;
  axis.most_jerk = 4000;
  AxisNow other = axis;
  other.position = other.command = 20;
  other.most_jerk = 2000;
  return {axis, other};
}

std::string error_of(const std::vector<TrajectoryPoint>& points) {
  const auto plan = plan_trajectory(points, two_axes());
  return plan ? "" : plan.error().text;
}

TEST(Trajectory, A_slow_one_is_followed_in_its_time) {
  const auto plan = plan_trajectory({{0, {0, 20}}, {2, {10, 22}}, {4, {20, 20}}}, two_axes());
  ASSERT_TRUE(plan) << plan.error().text;
  EXPECT_EQ(plan->stretch, 1);
  EXPECT_EQ(plan->slowest, -1);
  EXPECT_EQ(plan->duration, 4);
  ASSERT_EQ(plan->tables.size(), 2U);
  EXPECT_EQ(plan->tables[1].points, 2) << "the start is where the axes are";
  EXPECT_EQ(plan->tables[1].time[0], 2);
  EXPECT_EQ(plan->tables[1].value[0], 22);
}

TEST(Trajectory, What_cannot_be_followed_is_refused_with_its_reason) {
  EXPECT_EQ(error_of({}), "it has no points");
  EXPECT_THAT(error_of({{1, {0}}}), testing::HasSubstr("point 0 has 1 positions, the arm has 2 axes"));
  EXPECT_THAT(error_of({{1, {0, 20}}, {1, {1, 20}}}), testing::HasSubstr("the time of point 1, 1 s, is not above"));
  EXPECT_THAT(error_of({{-1, {0, 20}}}), testing::HasSubstr("the time of point 0"));
  EXPECT_THAT(error_of({{1, {0, 171}}}), testing::HasSubstr("171.000 is not within the ends of axis 2"));
  EXPECT_THAT(error_of({{1, {std::nan(""), 20}}}), testing::HasSubstr("not within the ends of axis 1"));
  EXPECT_THAT(error_of({{0, {1, 20}}, {1, {0, 20}}}), testing::HasSubstr("it begins 1.000 deg or mm away"));
  EXPECT_THAT(error_of({{0, {0, 20}}}), testing::HasSubstr("only the point at its start"));
  EXPECT_THAT(error_of({{1, {169, 20}}, {1.1, {169.9, 20}}, {3, {0, 20}}}),
              testing::HasSubstr("between its points, axis 1 would leave its range"));
}

// Random ones: with the stretched times no limit is exceeded, and one is reached. Speeds, accelerations and jerks are
// differences of places.
TEST(Trajectory, Times_are_stretched_as_much_as_the_limits_need) {
  std::mt19937 random(3);
  const auto any = [&random](double most) { return most * (2.0 * static_cast<double>(random()) / 4294967295.0 - 1); };
  for (int round = 0; round < 200; ++round) {
    std::vector<TrajectoryPoint> points;
    for (int i = 1; i <= 3 + round % 20; ++i) {
      points.push_back({0.3 * i + any(0.1), {any(60), 20 + any(60)}});
    }
    const auto axes = two_axes();
    const auto plan = plan_trajectory(points, axes);
    ASSERT_TRUE(plan) << plan.error().text;
    double nearest = 0;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      robot::LineState start;
      start.position = axes[k].command;
      robot::TimeProfile curve;
      ASSERT_EQ(curve.set(plan->tables[k], robot::TimeProfile::Of::Position, {plan->stretch, 1, 0}, start),
                robot::ErrorCode::Ok);
      constexpr double kStep = 1e-3;
      for (double t = 0; t + 3 * kStep < curve.duration(); t += kStep) {
        const auto place = [&](int i) { return curve.at(t + i * kStep).position; };
        const double speed = std::abs(place(1) - place(0)) / kStep / axes[k].most_velocity;
        const double acceleration =
            std::abs(place(2) - 2 * place(1) + place(0)) / kStep / kStep / axes[k].most_acceleration;
        const auto rate = [&](double at) { return curve.at(at).acceleration; };
        const double jerk = std::abs(rate(t + kStep) - rate(t)) / kStep / axes[k].most_jerk;
        ASSERT_LE(std::max({speed, acceleration, jerk}), 1.001) << "round " << round << ", axis " << k << ", " << t;
        nearest = std::max({nearest, speed, acceleration, jerk});
      }
    }
    EXPECT_TRUE(plan->stretch == 1 || nearest > 0.97) << nearest;
  }
}

TEST(Trajectory, More_points_than_a_table_has_are_met_by_fewer) {
  std::vector<TrajectoryPoint> smooth;
  std::vector<TrajectoryPoint> rough;
  for (int i = 1; i <= 1000; ++i) {
    const double t = 0.01 * i;
    smooth.push_back({t, {30 * std::sin(t), 20 - 15 * (1 - std::cos(2 * t))}});
    rough.push_back({t, {i % 2 == 0 ? 5.0 : -5.0, 20}});
  }
  const auto plan = plan_trajectory(smooth, two_axes());
  ASSERT_TRUE(plan) << plan.error().text;
  EXPECT_LE(plan->tables[0].points, 64);
  EXPECT_LE(plan->deviation, 0.1);
  EXPECT_THAT(error_of(rough), testing::HasSubstr("do not fit into a table of 64 places"));
}

}  // namespace
}  // namespace indurop::ros
