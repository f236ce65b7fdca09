// SPDX-License-Identifier: Apache-2.0
// Joint motions of the group as services ask for them: their axes arrive together, and a new target may come at any
// moment.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "group_cell.h"

namespace indurop::robot {
namespace {

// By the angle of axis 1, that of axis 6 on its way to `target`.
std::map<double, double> undisturbed(const AxisNumbers& target) {
  Cell cell("", 1);
  EXPECT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = target;
  cell.ask(Service::DirectAbsolute);
  std::map<double, double> path;
  EXPECT_TRUE(cell.until([&] {
    path[cell.out.command[0]] = cell.out.command[5];
    return cell.out.done == cell.in.service.number;
  }));
  return path;
}

TEST(Joint_group, Emergency_stop_brakes_on_the_path_then_takes_power_away) {
  const AxisNumbers target{100, 0, 0, 0, 0, 50};
  const std::map<double, double> path = undisturbed(target);
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = target;
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.emergency = true;
  double before = cell.out.path_speed;
  cell.step();
  EXPECT_EQ(cell.out.state, GroupState::Stopping);
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  ASSERT_TRUE(cell.until([&] {
    // On the path, never faster again.
    const auto next = path.lower_bound(cell.out.command[0]);
    EXPECT_NE(next, path.begin());
    const auto last = std::prev(next);
    const double part = (cell.out.command[0] - last->first) / (next->first - last->first);
    EXPECT_NEAR(cell.out.command[5], last->second + part * (next->second - last->second), 1e-4);
    EXPECT_LE(cell.out.path_speed, before + 0.5);
    before = cell.out.path_speed;
    return cell.out.state == GroupState::ErrorStop;
  }));
  EXPECT_EQ(cell.out.drives[0].control, 0x02);
  EXPECT_LT(cell.out.command[0], 99);
  EXPECT_EQ(cell.out.speed, AxisNumbers{});
  EXPECT_FALSE(cell.serve(Service::GroupReset));
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  cell.in.emergency = false;
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  EXPECT_EQ(cell.out.state, GroupState::Disabled);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.error, ErrorCode::Ok);
  cell.in.service.target = {};
  EXPECT_TRUE(cell.serve(Service::DirectAbsolute));
}

// As soon as it can be there without a stop: sooner than a stop and a new motion, and at once.
TEST(Joint_group, A_new_target_takes_over_without_a_stop) {
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  const std::uint32_t first = cell.in.service.number;
  cell.in.service.target = {150, 20, 0, 0, 0, 0};
  cell.ask(Service::DirectAborting);
  double slowest = HUGE_VAL;
  ASSERT_TRUE(cell.until([&] {
    slowest = cell.out.command[0] < 120 ? std::min(slowest, cell.out.speed[0]) : slowest;
    return cell.out.done == cell.in.service.number;
  }));
  EXPECT_EQ(cell.out.error, ErrorCode::Ok);
  EXPECT_NE(cell.out.acknowledged, first);
  EXPECT_GT(slowest, 150);
  EXPECT_NEAR(cell.out.command[0], 150, 1e-9);
  EXPECT_NEAR(cell.out.command[5], 0, 1e-9);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

TEST(Joint_group, A_new_target_takes_over_from_a_line_and_from_one_that_is_being_planned) {
  Cell cell("", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {0, 0, 0, 0, 90, 0};
  ASSERT_TRUE(cell.serve(Service::DirectAborting));  // also from rest
  cell.in.service.target = {500, 100, 400, 180, 0, 180};
  cell.ask(Service::LinearAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.tool_speed > 100; }));
  cell.in.service.target = {500, -100, 400, 180, 0, 180};
  cell.ask(Service::LinearAbsolute);
  cell.step();
  cell.in.service.target = {30, 0, 0, 0, 90, 0};
  ASSERT_TRUE(cell.serve(Service::DirectAborting));
  EXPECT_NEAR(cell.out.command[0], 30, 1e-9);
  EXPECT_EQ(cell.out.state, GroupState::Standby);
}

// As fast as the service says, like any other joint motion.
TEST(Joint_group, A_new_target_is_taken_at_the_speed_that_is_asked_for) {
  for (const Service service : {Service::DirectAbsolute, Service::DirectAborting}) {
    for (const double velocity : {0.0, 40.0}) {
      Cell cell("", 1);
      ASSERT_TRUE(cell.serve(Service::GroupEnable));
      cell.in.service.target = {100, 0, 0, 0, 0, 0};
      cell.in.service.speed = 20;
      cell.in.service.velocity = velocity;
      cell.ask(service);
      double fastest = 0;
      ASSERT_TRUE(cell.until([&] {
        fastest = std::max(fastest, cell.out.speed[0]);
        return cell.out.done == cell.in.service.number;
      }));
      const double part = velocity > 0 ? velocity : 20;
      EXPECT_NEAR(fastest, degrees(cell_limits().velocity[0]) * part / 100, 0.1);
    }
  }
}

TEST(Joint_group, A_new_target_that_cannot_be_changes_nothing) {
  Cell cell("", 1);
  EXPECT_FALSE(cell.serve(Service::DirectAborting));
  EXPECT_EQ(cell.out.error, ErrorCode::State);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {100, 0, 0, 0, 0, 50};
  cell.ask(Service::DirectAbsolute);
  ASSERT_TRUE(cell.until([&] { return cell.out.path_speed > 90; }));
  cell.in.service.target = {0, 9999, 0, 0, 0, 0};
  EXPECT_FALSE(cell.serve(Service::DirectAborting));
  EXPECT_EQ(cell.out.error, ErrorCode::JointLimit);
  EXPECT_EQ(cell.out.error_axis, 2U);
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::Standby; }));
  EXPECT_NEAR(cell.out.command[0], 100, 1e-9);
}

TEST(Joint_group, STRAIGHT_keeps_the_line_between_joint_angles) {
  Cell cell("POINT FAR = JOINT 100 0 0 0 0 50\nMOVJ FAR STRAIGHT\n", 1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.job = 1;
  cell.ask(Service::JobStart);
  ASSERT_TRUE(cell.until([&] {
    EXPECT_NEAR(cell.out.command[5], cell.out.command[0] / 2, 1e-6);
    return cell.out.done == cell.in.service.number;
  }));
  EXPECT_NEAR(cell.out.command[0], 100, 1e-9);
}

}  // namespace
}  // namespace indurop::robot
