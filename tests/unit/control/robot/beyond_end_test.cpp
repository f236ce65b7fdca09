// SPDX-License-Identifier: Apache-2.0
// Axes that stand beyond the end that the URDF declares, by a push without power or a hair of the encoder: they may be
// brought back, not driven further out.

#include <cmath>
#include <random>

#include "group_cell.h"

namespace indurop::robot {
namespace {

class Beyond_end : public testing::TestWithParam<double> {
 protected:
  static constexpr double kCounts = 1'320'000.0 / 360;  // per degree
  // The first axis stands `param` degrees beyond its upper end.
  Beyond_end() : upper(degrees(cell_arm().axis(0).upper)) {
    place(GetParam());
    cell.step();
  }
  void place(double beyond) {
    cell.in.drives[0].position = static_cast<std::int32_t>(std::ceil((upper + beyond) * kCounts));
    start = cell.in.drives[0].position / kCounts;
  }
  bool until_rest() {
    return cell.until([&] {
      EXPECT_LE(cell.out.command[0], start + 1e-9) << "further out";
      return !cell.out.busy;
    });
  }
  Cell cell{"", 1};
  double upper;
  double start = 0;
};

TEST_P(Beyond_end, Nothing_is_wrong_while_there_is_no_power) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    place(GetParam() + std::uniform_real_distribution<double>(-0.02, 0.02)(random));  // the encoder's noise
    cell.step();
    ASSERT_EQ(cell.out.state, GroupState::Disabled);
    ASSERT_EQ(cell.out.error, ErrorCode::Ok);
  }
}

TEST_P(Beyond_end, The_group_comes_back_with_one_motion) {
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  EXPECT_NEAR(cell.out.command[0], start, 1e-9) << "it has to stay where it is";
  cell.in.service.target = {upper - 5, 0, 0, 0, 0, 0};
  cell.ask(Service::DirectAbsolute);
  cell.step();
  ASSERT_TRUE(until_rest());
  EXPECT_EQ(cell.out.error, ErrorCode::Ok);
  EXPECT_NEAR(cell.out.command[0], upper - 5, 1e-6);
}

TEST_P(Beyond_end, A_new_target_and_a_single_axis_come_back_too) {
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {upper - 1, 0, 0, 0, 0, 0};
  ASSERT_TRUE(cell.serve(Service::DirectAborting));
  EXPECT_NEAR(cell.out.command[0], upper - 1, 1e-6);
  cell.in.service.number = cell.out.acknowledged;
  ASSERT_TRUE(cell.serve(Service::GroupDisable));
  place(GetParam());
  cell.step();
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  ASSERT_TRUE(cell.serve_axis(0, AxisService::MoveAbsolute, upper - 2));
  EXPECT_NEAR(cell.out.command[0], upper - 2, 1e-6);
}

TEST_P(Beyond_end, By_hand_it_comes_back_and_does_not_go_on) {
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.jog.enabled = true;
  cell.in.jog.speed[0] = 20;
  for (int i = 0; i < 500; ++i) {
    cell.step();
    ASSERT_NEAR(cell.out.command[0], start, 1e-9);
  }
  cell.in.jog.speed[0] = -20;
  ASSERT_TRUE(cell.until([&] { return cell.out.command[0] < upper - 1; }));
  EXPECT_EQ(cell.out.error, ErrorCode::Ok);
}

TEST_P(Beyond_end, Further_out_is_refused) {
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  cell.in.service.target = {start + 1, 0, 0, 0, 0, 0};
  EXPECT_FALSE(cell.serve(Service::DirectAbsolute));
  EXPECT_EQ(cell.out.error, ErrorCode::JointLimit);
  EXPECT_FALSE(cell.serve_axis(0, AxisService::MoveAbsolute, start + 1));
  cell.ask_axis(0, AxisService::MoveVelocity, 0, 10);
  for (int i = 0; i < 300; ++i) {
    cell.step();
    ASSERT_LE(cell.out.command[0], start + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(By, Beyond_end, testing::Values(0.0003, 2.0));

}  // namespace
}  // namespace indurop::robot
