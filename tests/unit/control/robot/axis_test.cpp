// SPDX-License-Identifier: Apache-2.0
// Single axes, as their services move them while the group rests.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "group_cell.h"

namespace indurop::robot {
namespace {

TEST(Axis, Moves_as_a_single_axis_while_the_group_is_at_standstill) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(1, AxisService::PowerOn));
  EXPECT_TRUE(cell.out.axes[1].power);
  EXPECT_FALSE(cell.out.axes[0].power);
  EXPECT_FALSE(cell.serve_axis(0, AxisService::MoveAbsolute, 5));
  EXPECT_EQ(cell.out.axes[0].error, ErrorCode::State);
  ASSERT_TRUE(cell.serve_axis(1, AxisService::MoveAbsolute, 20, 30));
  EXPECT_NEAR(cell.out.command[1], 20, 1e-9);
  ASSERT_TRUE(cell.serve_axis(1, AxisService::MoveRelative, -5));
  EXPECT_NEAR(cell.out.command[1], 15, 1e-9);
  EXPECT_FALSE(cell.serve_axis(1, AxisService::MoveAbsolute, 500));
  EXPECT_EQ(cell.out.axes[1].error, ErrorCode::JointLimit);
  ASSERT_TRUE(cell.serve_axis(1, AxisService::MoveVelocity, 0, 10));
  EXPECT_TRUE(cell.out.axes[1].in_velocity);
  EXPECT_EQ(cell.out.axes[1].state, AxisState::ContinuousMotion);
  ASSERT_TRUE(cell.serve_axis(1, AxisService::Stop));
  EXPECT_EQ(cell.out.axes[1].state, AxisState::Standstill);
  ASSERT_TRUE(cell.serve_axis(1, AxisService::PowerOff));
  cell.step();
  cell.step();
  EXPECT_EQ(cell.out.axes[1].state, AxisState::Disabled);
}

TEST(Axis, A_later_request_aborts_the_one_before) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(0, AxisService::PowerOn));
  cell.ask_axis(0, AxisService::MoveAbsolute, 100);
  cell.step();
  cell.step();
  const std::uint32_t first = cell.in.axes[0].number;
  ASSERT_TRUE(cell.serve_axis(0, AxisService::MoveAbsolute, -10));
  EXPECT_EQ(cell.out.axes[0].aborted, first);
  EXPECT_NEAR(cell.out.command[0], -10, 1e-9);
}

TEST(Axis, A_motion_without_target_stops_before_the_limit) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(4, AxisService::PowerOn));
  cell.ask_axis(4, AxisService::MoveVelocity, 0, 200);
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[4].error == ErrorCode::JointLimit; }));
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[4].velocity == 0; }));
  EXPECT_GT(cell.out.command[4], 110);
  EXPECT_LT(cell.out.command[4], degrees(2.094));
}

TEST(Axis, What_is_asked_for_is_something) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(0, AxisService::PowerOn));
  for (double AxisRequest::*part : {&AxisRequest::velocity, &AxisRequest::acceleration, &AxisRequest::jerk}) {
    for (const double little : {1e-300, 1e-9, -1e-300}) {
      cell.ask_axis(0, AxisService::MoveAbsolute, 10);
      cell.in.axes[0].*part = little;
      cell.step();
      EXPECT_EQ(cell.out.axes[0].error, ErrorCode::Value);
      EXPECT_EQ(cell.out.axes[0].aborted, cell.in.axes[0].number);
    }
  }
}

TEST(Axis, Hold_and_override_act_on_it_too) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(0, AxisService::PowerOn));
  cell.in.speed_override = 50;
  cell.ask_axis(0, AxisService::MoveAbsolute, 150, 40);
  double fastest = 0;
  ASSERT_TRUE(cell.until([&] {
    fastest = std::max(fastest, cell.out.axes[0].velocity);
    return cell.out.command[0] > 40;
  }));
  EXPECT_NEAR(fastest, 20, 1e-6);
  cell.in.hold = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[0].velocity == 0; }));
  const double here = cell.out.command[0];
  for (int i = 0; i < 50; ++i) {
    cell.step();
  }
  EXPECT_EQ(cell.out.command[0], here);
  EXPECT_EQ(cell.out.axes[0].state, AxisState::DiscreteMotion);
  EXPECT_NE(cell.out.axes[0].done, cell.in.axes[0].number);
  cell.in.hold = false;
  cell.in.speed_override = 100;
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[0].done == cell.in.axes[0].number; }));
  EXPECT_NEAR(cell.out.command[0], 150, 1e-9);
}

TEST(Axis, Hold_and_override_act_on_motions_without_target) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(0, AxisService::PowerOn));
  ASSERT_TRUE(cell.serve_axis(0, AxisService::MoveVelocity, 0, -20));
  cell.in.speed_override = 25;
  ASSERT_TRUE(cell.until([&] { return std::abs(cell.out.axes[0].velocity + 5) < 1e-9; }));
  cell.in.hold = true;
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[0].velocity == 0; }));
  cell.step();
  EXPECT_FALSE(cell.out.axes[0].in_velocity);
  EXPECT_EQ(cell.out.axes[0].state, AxisState::ContinuousMotion);
  cell.ask_axis(0, AxisService::MoveAbsolute, 10);
  for (int i = 0; i < 50; ++i) {
    cell.step();
  }
  EXPECT_EQ(cell.out.axes[0].velocity, 0);  // taken, but held
  cell.in.hold = false;
  cell.in.speed_override = 100;
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[0].done == cell.in.axes[0].number; }));
  EXPECT_NEAR(cell.out.command[0], 10, 1e-9);
}

TEST(Axis, A_stop_is_not_held_up_by_the_override) {
  Cell cell;
  ASSERT_TRUE(cell.serve_axis(0, AxisService::PowerOn));
  ASSERT_TRUE(cell.serve_axis(0, AxisService::MoveVelocity, 0, 20));
  cell.in.speed_override = 0;
  EXPECT_TRUE(cell.serve_axis(0, AxisService::Stop));
  EXPECT_EQ(cell.out.axes[0].state, AxisState::Standstill);
}

TEST(Axis, A_reset_waits_until_it_stands_still) {
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.drives[3].status = Cell::kFault;
  cell.step();
  cell.ask_axis(0, AxisService::Reset);
  cell.step();
  cell.step();
  EXPECT_EQ(cell.out.axes[0].state, AxisState::SynchronizedMotion) << "it brakes on the path of the group";
  EXPECT_NE(cell.out.axes[0].done, cell.in.axes[0].number);
  ASSERT_TRUE(cell.until([&] { return cell.out.axes[0].done == cell.in.axes[0].number; }));
  EXPECT_EQ(cell.out.axes[0].velocity, 0);
}

TEST(Axis_limits, Each_axis_has_its_own_acceleration_and_jerk) {
  constexpr double kStep = 0.001;
  Settings settings;
  settings.acceleration = {400, 100, 800, 900, 1000, 1100};
  settings.jerk = {8000, 400, 9000, 9000, 9000, 9000};
  Cell cell("", 1, 0, true, settings);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    double position = cell.out.command[axis];
    double speed = 0;
    double acceleration = 0;
    double hardest = 0;
    double jerk = 0;
    cell.ask_axis(axis, AxisService::MoveRelative, 40, 1000);
    for (int i = 0; i < 3000; ++i) {
      cell.step();
      const double v = (cell.out.command[axis] - position) / kStep;
      const double a = (v - speed) / kStep;
      jerk = std::max(jerk, std::abs(a - acceleration) / kStep);
      hardest = std::max(hardest, std::abs(a));
      position = cell.out.command[axis];
      speed = v;
      acceleration = a;
    }
    EXPECT_NEAR(hardest, settings.acceleration[axis], 0.01 * settings.acceleration[axis]);
    EXPECT_NEAR(jerk, settings.jerk[axis], 0.01 * settings.jerk[axis]);
  }
}

TEST(Axis_limits, Accelerations_of_another_number_of_axes_are_refused) {
  Settings settings;
  settings.acceleration = {400, 100};
  settings.jerk = {1, 2, 3, 4, 5, -6};
  EXPECT_THROW(Cell("", 1, 0, true, settings), std::runtime_error);
}

}  // namespace
}  // namespace indurop::robot
