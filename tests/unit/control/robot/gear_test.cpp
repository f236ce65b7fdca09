// SPDX-License-Identifier: Apache-2.0
// Axes in gear and on cams: whatever the master does and whenever it begins, no set point breaks a limit; once in gear
// each step of the follower is that of its master times the ratio, on a cam it is where the curve is.

#include "control/robot/axis/cam.h"

#include "follow_cell.h"

namespace indurop::robot {
namespace {

class Gears : public FollowCell {};

TEST_F(Gears, A_follower_at_rest_catches_up_and_keeps_the_ratio) {
  give(1, AxisService::MoveVelocity, 0, 30);
  ASSERT_TRUE(until([&] { return joint(0) > 10; }));
  const Given in = gear(2, 1, -3, 4);
  step();
  EXPECT_EQ(state(in), CommandState::Active);
  EXPECT_EQ(axis(1), AxisState::SynchronizedMotion);
  EXPECT_FALSE(reached(in));
  ASSERT_TRUE(until([&] { return reached(in); }));
  give(1, AxisService::MoveAbsolute, 0, 60);
  for (int i = 0; i < 500; ++i) {
    step();
    ASSERT_NEAR(moved(1), -0.75 * moved(0), 1e-9);
    ASSERT_TRUE(reached(in));
  }
  EXPECT_EQ(state(in), CommandState::Active);
  EXPECT_EQ(axis(0), AxisState::Standstill);
  EXPECT_EQ(axis(1), AxisState::SynchronizedMotion);
}

TEST_F(Gears, Going_out_of_gear_keeps_the_speed) {
  give(1, AxisService::MoveVelocity, 0, 30);
  const Given in = gear(2, 1, 1, 2);
  ASSERT_TRUE(until([&] { return reached(in) && moved(0) > 0.3 - 1e-9; }));
  const Given out = give(2, AxisService::Decouple);
  step();
  EXPECT_EQ(state(in), CommandState::Aborted);
  EXPECT_EQ(state(out), CommandState::Done);
  EXPECT_EQ(axis(1), AxisState::ContinuousMotion);
  give(1, AxisService::Halt);
  for (int i = 0; i < 100; ++i) {
    step();
    EXPECT_NEAR(moved(1), 0.15, 1e-9);
  }
  EXPECT_EQ(axis(0), AxisState::Standstill);
  const Given again = give(2, AxisService::Decouple);
  step();
  EXPECT_EQ(error(again), ErrorCode::State);
}

TEST_F(Gears, What_cannot_be_is_refused_and_moves_nothing) {
  give(2, AxisService::MoveVelocity, 0, 20);
  ASSERT_TRUE(until([&] { return moved(1) > 0.2 - 1e-9; }));
  const std::pair<Given, ErrorCode> all[] = {
      {gear(2, 1, 1, 0), ErrorCode::Value},   {gear(2, 1, std::nan(""), 1), ErrorCode::Value},
      {gear(2, 2, 1), ErrorCode::Value},      {gear(2, 0, 1), ErrorCode::Value},
      {gear(2, 9, 1), ErrorCode::Value},      {gear(2, -3, 1), ErrorCode::Value},
      {gear(2, 1, 1e9, 1), ErrorCode::Value}, {gear(2, 5, 1), ErrorCode::Master},
      {gear(5, 2, 1), ErrorCode::State}};
  for (const auto& [given, code] : all) {
    step();
    EXPECT_EQ(error(given), code) << given.number;
    EXPECT_NEAR(moved(1), 0.2, 1e-9);
  }
  EXPECT_EQ(axis(1), AxisState::ContinuousMotion);
}

TEST_F(Gears, No_axis_follows_itself_through_others) {
  const Given first = gear(2, 1, 1);
  const Given second = gear(3, 2, -1);
  const Given third = gear(1, 3, 1);
  step();
  EXPECT_EQ(state(first), CommandState::Active);
  EXPECT_EQ(state(second), CommandState::Active);
  EXPECT_EQ(error(third), ErrorCode::Value);
  give(1, AxisService::MoveAbsolute, 30, 40);
  ASSERT_TRUE(until([&] { return joint(0) > 29.999; }));
  EXPECT_NEAR(joint(1), 30, 0.01);
  EXPECT_NEAR(joint(2), -30, 0.01);
}

TEST_F(Gears, A_master_that_is_too_fast_is_left) {
  give(1, AxisService::MoveVelocity, 0, 10);
  const Given in = gear(2, 1, 5);
  ASSERT_TRUE(until([&] { return reached(in); }));
  give(1, AxisService::MoveVelocity, 0, 0);  // as fast as it can
  ASSERT_TRUE(until([&] { return ended(in); }));
  EXPECT_EQ(state(in), CommandState::Error);
  EXPECT_TRUE(error(in) == ErrorCode::Speed || error(in) == ErrorCode::Acceleration || error(in) == ErrorCode::Jerk);
  EXPECT_EQ(axis(1), AxisState::Stopping);
  ASSERT_TRUE(until([&] { return axis(1) == AxisState::Standstill; }));
  EXPECT_EQ(axis(0), AxisState::ContinuousMotion) << "the master has nothing to do with it";
}

TEST_F(Gears, The_end_of_the_follower_ends_it) {
  give(1, AxisService::MoveVelocity, 0, 40);
  const Given in = gear(2, 1, 1);
  ASSERT_TRUE(until([&] { return ended(in); }));
  EXPECT_EQ(error(in), ErrorCode::JointLimit);
  ASSERT_TRUE(until([&] { return axis(1) == AxisState::Standstill; }))
      << static_cast<int>(axis(1)) << " group " << static_cast<int>(cell.out.state) << " error "
      << static_cast<int>(cell.out.error) << " " << joint(1);
  EXPECT_GT(joint(1), cell.out.axes[1].upper - 5);
}

TEST_F(Gears, A_master_without_power_is_left) {
  give(1, AxisService::MoveVelocity, 0, 40);
  const Given in = gear(2, 1, 1);
  ASSERT_TRUE(until([&] { return reached(in) && moved(0) > 0.39; }));
  cell.in.drives[0].status = Cell::kFault;
  step();
  EXPECT_EQ(axis(0), AxisState::ErrorStop);
  EXPECT_EQ(error(in), ErrorCode::Master);
  EXPECT_EQ(axis(1), AxisState::Stopping);
  ASSERT_TRUE(until([&] { return axis(1) == AxisState::Standstill; }));
}

// The master's own motion sees no end, but the sum with the superimposed one reaches it, so that its gate brakes.
TEST_F(Gears, A_master_that_its_gate_brakes_is_followed_to_standstill) {
  give(1, AxisService::MoveVelocity, 0, 20);
  const Given on_top = give(1, AxisService::MoveSuperimposed, 60, 40);
  ASSERT_TRUE(done(on_top));
  const Given in = gear(2, 1, 0.03);
  ASSERT_TRUE(until([&] { return reached(in); }));
  bool braked = false;
  for (int i = 0; i < 1000 && axis(0) != AxisState::Standstill; ++i) {
    step();
    ASSERT_NEAR(moved(1), 0.03 * moved(0), 1e-9) << joint(0);
    ASSERT_TRUE(reached(in));
    braked = braked || axis(0) == AxisState::Stopping;
  }
  EXPECT_TRUE(braked);
  EXPECT_GT(joint(0), cell.out.axes[0].upper - 5);
  EXPECT_EQ(moved(1), 0);
  EXPECT_EQ(axis(1), AxisState::SynchronizedMotion);
}

TEST_F(Gears, Other_motions_take_over_and_a_buffered_one_follows) {
  give(1, AxisService::MoveVelocity, 0, 40);
  const Given in = gear(2, 1, 1);
  ASSERT_TRUE(until([&] { return joint(1) > 10; }));
  const Given back = give(2, AxisService::MoveAbsolute, -20);
  const Given geared = gear(2, 1, 1, 2, BufferMode::Buffered);
  step();
  EXPECT_EQ(state(in), CommandState::Aborted);
  EXPECT_EQ(state(back), CommandState::Active);
  EXPECT_EQ(axis(1), AxisState::DiscreteMotion);
  EXPECT_EQ(state(geared), CommandState::Waits);
  ASSERT_TRUE(until([&] { return state(back) == CommandState::Done; }));
  EXPECT_NEAR(joint(1), -20, 1e-6);
  ASSERT_TRUE(until([&] { return reached(geared); }));
  step();
  EXPECT_NEAR(moved(1), moved(0) / 2, 1e-9);
}

TEST_F(Gears, A_new_ratio_counts_at_once) {
  give(1, AxisService::MoveVelocity, 0, 20);
  const Given in = gear(2, 1, 1);
  ASSERT_TRUE(until([&] { return reached(in); }));
  command(in).to[0] = -2;
  ++command(in).updates;
  step();
  EXPECT_FALSE(reached(in));
  EXPECT_EQ(state(in), CommandState::Active);
  ASSERT_TRUE(until([&] { return reached(in); }));
  step();
  EXPECT_NEAR(moved(1), -2 * moved(0), 1e-9);
}

TEST_F(Gears, The_group_does_not_move_meanwhile) {
  ASSERT_TRUE(done(give(Service::GroupEnable)));
  const Given in = gear(2, 1, 1);
  step();
  const Given group = give(Service::DirectAbsolute, {10, 0, 0, 0, 0, 0});
  step();
  EXPECT_EQ(error(group), ErrorCode::State);
  EXPECT_EQ(state(in), CommandState::Active);
  const Given stop = give(Service::Stop);
  step();
  EXPECT_EQ(state(in), CommandState::Aborted);
  ASSERT_TRUE(until([&] { return state(stop) == CommandState::Done; }));
}

class Cams : public FollowCell {
 protected:
  const std::vector<std::pair<double, double>> hill_{{0, 0}, {20, 15}, {40, 0}};
};

TEST_F(Cams, A_follower_gets_onto_the_cam_and_stays_on_it) {
  ASSERT_TRUE(done(select(1, hill_, true)));
  give(1, AxisService::MoveVelocity, 0, 20);
  ASSERT_TRUE(until([&] { return joint(0) > 33; }));
  const Given in = cam(2, 1, 1, {.slave_offset = 10, .slave_scale = -2});
  step();
  EXPECT_EQ(axis(1), AxisState::SynchronizedMotion);
  EXPECT_FALSE(reached(in));
  ASSERT_TRUE(until([&] { return reached(in); }));
  bool at_top = false;
  while (joint(0) < 120) {
    step();
    ASSERT_TRUE(reached(in));
    // Its points are 20 degrees from each other.
    const double to_point = std::remainder(joint(0), 20);
    const bool top = std::lround((joint(0) - to_point) / 20) % 2 != 0;
    if (std::abs(to_point) < 0.11) {
      EXPECT_NEAR(joint(1), top ? -20 : 10, 0.02);
      at_top = at_top || top;
    }
  }
  EXPECT_TRUE(at_top);
  const Given out = give(2, AxisService::Decouple);
  step();
  EXPECT_EQ(state(out), CommandState::Done);
  EXPECT_EQ(axis(1), AxisState::ContinuousMotion);
}

TEST_F(Cams, Count_from_where_both_are_if_they_are_relative) {
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 50)));
  ASSERT_TRUE(done(give(2, AxisService::MoveAbsolute, 7)));
  ASSERT_TRUE(done(select(1, hill_, false)));
  step();
  const Given in = cam(2, 1, 1, {.master_absolute = false, .slave_absolute = false});
  ASSERT_TRUE(until([&] { return reached(in); }));
  EXPECT_NEAR(joint(1), 7, 1e-9);
  ASSERT_TRUE(done(give(1, AxisService::MoveRelative, 20, 30)));
  EXPECT_NEAR(joint(1), 22, 1e-9);
  ASSERT_TRUE(done(give(1, AxisService::MoveRelative, 40, 30)));
  EXPECT_NEAR(joint(1), 7, 1e-9) << "it stays where the cam ends";
  EXPECT_TRUE(reached(in));
}

TEST_F(Cams, That_cannot_be_are_refused_and_move_nothing) {
  EXPECT_FALSE(done(select(1, {{0, 0}, {20, 5}, {10, 0}}, false)));
  const Given none_there = select(4, hill_, false);
  command(none_there).option = 5;
  EXPECT_FALSE(done(none_there));
  ASSERT_TRUE(done(select(2, hill_, true)));
  const std::pair<Given, ErrorCode> all[] = {{cam(2, 1, 1, {}), ErrorCode::Value},
                                             {cam(2, 1, 0, {}), ErrorCode::Value},
                                             {cam(2, 1, 2, {.master_scale = 0}), ErrorCode::Value},
                                             {cam(2, 1, 2, {.slave_scale = std::nan("")}), ErrorCode::Value},
                                             {cam(2, 2, 2, {}), ErrorCode::Value},
                                             {cam(2, 4, 2, {}), ErrorCode::Master},
                                             {cam(2, 1, 2, {.slave_scale = 100}), ErrorCode::JointLimit},
                                             {cam(2, 1, 2, {.slave_offset = -400}), ErrorCode::JointLimit}};
  for (const auto& [given, code] : all) {
    step();
    EXPECT_EQ(error(given), code) << given.number;
    EXPECT_EQ(moved(1), 0);
  }
  EXPECT_EQ(axis(1), AxisState::Standstill);
}

TEST_F(Cams, During_a_hold_no_axis_catches_up) {
  ASSERT_TRUE(done(select(1, hill_, true)));
  const Given in = cam(2, 1, 1, {.slave_offset = 60});
  ASSERT_TRUE(until([&] { return joint(1) > 10; }));
  cell.in.hold = true;
  ASSERT_TRUE(until([&] { return moved(1) == 0; }));
  const double rests = joint(1);
  for (int i = 0; i < 100; ++i) {
    step();
    EXPECT_EQ(joint(1), rests);
    EXPECT_FALSE(reached(in));
  }
  EXPECT_LT(rests, 59);
  cell.in.hold = false;
  ASSERT_TRUE(until([&] { return reached(in); }));
  EXPECT_NEAR(joint(1), 60, 1e-9);
}

TEST_F(Cams, The_one_before_is_followed_until_the_next_one_is_asked_for) {
  ASSERT_TRUE(done(select(1, hill_, true)));
  const Given in = cam(2, 1, 1, {});
  ASSERT_TRUE(until([&] { return reached(in); }));
  ASSERT_TRUE(done(select(1, {{0, 30}, {20, 30}, {40, 30}}, true)));
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 20, 20)));
  EXPECT_NEAR(joint(1), 15, 1e-9);
  const Given other = cam(2, 1, 1, {});
  ASSERT_TRUE(until([&] { return reached(other); }));
  EXPECT_EQ(state(in), CommandState::Aborted);
  EXPECT_NEAR(joint(1), 30, 1e-9);
}

}  // namespace
}  // namespace indurop::robot
