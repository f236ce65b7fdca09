// SPDX-License-Identifier: Apache-2.0
// Motions on top of what an axis does; random ones are in gear_test.cpp.
#include "follow_cell.h"

namespace indurop::robot {
namespace {

class OnTop : public FollowCell {
 protected:
  Given over(int axis, double by, double velocity = 0) {
    return give(axis, AxisService::MoveSuperimposed, by, velocity);
  }
};

TEST_F(OnTop, Of_a_motion_it_moves_on_and_both_end) {
  const Given under = give(1, AxisService::MoveAbsolute, 60, 30);
  ASSERT_TRUE(until([&] { return joint(0) > 20; }));
  const Given on_top = over(1, 10, 20);
  step();
  EXPECT_EQ(state(under), CommandState::Active);
  EXPECT_EQ(state(on_top), CommandState::Active);
  EXPECT_EQ(axis(0), AxisState::DiscreteMotion);
  double fastest = 0;
  ASSERT_TRUE(until([&] {
    fastest = std::max(fastest, moved(0) * 100);
    return ended(on_top);
  }));
  EXPECT_NEAR(fastest, 50, 0.1);
  EXPECT_EQ(state(on_top), CommandState::Done);
  EXPECT_EQ(state(under), CommandState::Active) << "its own motion goes on";
  ASSERT_TRUE(done(under));
  EXPECT_NEAR(joint(0), 70, 1e-6);
  EXPECT_EQ(axis(0), AxisState::Standstill);
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 60)));
  EXPECT_NEAR(joint(0), 60, 1e-6) << "places are those of the axis again";
}

TEST_F(OnTop, Of_nothing_it_is_a_motion) {
  const Given on_top = over(2, -12);
  step();
  EXPECT_EQ(axis(1), AxisState::DiscreteMotion);
  ASSERT_TRUE(done(on_top));
  EXPECT_NEAR(joint(1), -12, 1e-6);
  EXPECT_EQ(axis(1), AxisState::Standstill);
}

TEST_F(OnTop, Of_the_fastest_motion_it_waits_for_room) {
  const Given under = give(1, AxisService::MoveAbsolute, 150);
  ASSERT_TRUE(until([&] { return joint(0) > 40; }));
  const Given on_top = over(1, 5);
  ASSERT_TRUE(done(on_top));
  ASSERT_TRUE(until([&] { return axis(0) == AxisState::Standstill; }));
  EXPECT_EQ(state(under), CommandState::Done);
  EXPECT_NEAR(joint(0), 155, 1e-6);
}

TEST_F(OnTop, Of_a_gear_it_shifts_the_follower) {
  give(1, AxisService::MoveVelocity, 0, 20);
  const Given in = gear(2, 1, 1);
  ASSERT_TRUE(until([&] { return reached(in); }));
  const double apart = joint(1) - joint(0);
  const Given on_top = over(2, -15);
  step();
  EXPECT_EQ(axis(1), AxisState::SynchronizedMotion);
  ASSERT_TRUE(done(on_top));
  EXPECT_NEAR(joint(1) - joint(0), apart - 15, 1e-6);
  EXPECT_TRUE(reached(in));
}

TEST_F(OnTop, A_halt_ends_it_and_not_what_is_below) {
  const Given under = give(1, AxisService::MoveVelocity, 0, 20);
  ASSERT_TRUE(until([&] { return reached(under); }));
  const Given on_top = over(1, 100, 30);
  ASSERT_TRUE(until([&] { return moved(0) > 0.5 - 1e-9; }));
  const Given halt = give(1, AxisService::HaltSuperimposed);
  step();
  EXPECT_EQ(state(on_top), CommandState::Aborted);
  ASSERT_TRUE(done(halt));
  step();
  step();
  EXPECT_NEAR(moved(0), 0.2, 1e-9);
  EXPECT_EQ(state(under), CommandState::Active);
  const Given again = give(1, AxisService::HaltSuperimposed);
  step();
  EXPECT_EQ(error(again), ErrorCode::State);
}

TEST_F(OnTop, Others_take_over_from_where_both_are) {
  give(1, AxisService::MoveAbsolute, 90, 30);
  ASSERT_TRUE(until([&] { return joint(0) > 10; }));
  const Given on_top = over(1, 30, 20);
  ASSERT_TRUE(until([&] { return moved(0) > 0.5 - 1e-9; }));
  const double there = joint(0);
  const Given by = give(1, AxisService::MoveRelative, 25, 40);
  const Given waits = give(1, AxisService::MoveAbsolute, 0, 40, BufferMode::Buffered);
  step();
  EXPECT_EQ(state(on_top), CommandState::Aborted);
  ASSERT_TRUE(done(by));
  EXPECT_NEAR(joint(0), there + 25, 1e-6);
  ASSERT_TRUE(done(waits));
}

TEST_F(OnTop, What_cannot_be_is_refused) {
  give(1, AxisService::MoveAbsolute, 100, 30);
  step();
  const Given beyond = over(1, 100);
  const Given no_number = over(1, std::nan(""));
  const Given no_power = over(5, 1);
  step();
  EXPECT_EQ(error(beyond), ErrorCode::JointLimit);
  EXPECT_EQ(error(no_number), ErrorCode::Value);
  EXPECT_EQ(error(no_power), ErrorCode::State);
  EXPECT_EQ(axis(0), AxisState::DiscreteMotion);
}

TEST_F(OnTop, The_end_of_the_axis_ends_both) {
  const Given under = give(2, AxisService::MoveVelocity, 0, 20);
  const Given on_top = over(2, 300, 10);
  ASSERT_TRUE(until([&] { return ended(on_top); }));
  EXPECT_EQ(error(on_top), ErrorCode::JointLimit);
  EXPECT_EQ(error(under), ErrorCode::JointLimit);
  ASSERT_TRUE(until([&] { return axis(1) == AxisState::Standstill; }));
}

}  // namespace
}  // namespace indurop::robot
