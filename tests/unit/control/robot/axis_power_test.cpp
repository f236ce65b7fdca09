// SPDX-License-Identifier: Apache-2.0
// Power of single axes as MC_Power asks for it: it follows a command as long as that has its Execute (PLCopen Motion
// Control part 1, figure of the states: notes 1 to 5).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "command_cell.h"

namespace indurop::robot {
namespace {

class Axis_power : public testing::Test, public CommandCell {
 protected:
  Given hold_power(int axis) {
    const Given given = give(axis, AxisService::PowerOn);
    command(given).option = command(given).execute = 1;
    return given;
  }
  bool becomes(AxisState state) {
    return cell.until([&] { return axis(0) == state; });
  }
  bool stays(AxisState state) {
    return !cell.until([&] { return axis(0) != state; }, 500);
  }
};

TEST_F(Axis_power, Follows_its_execute) {
  const Given power = hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  EXPECT_TRUE(stays(AxisState::Standstill));
  EXPECT_EQ(state(power), CommandState::Done);
  EXPECT_EQ(axis(1), AxisState::Disabled);
  command(power).execute = 0;
  EXPECT_TRUE(becomes(AxisState::Disabled));
  EXPECT_TRUE(stays(AxisState::Disabled));
}

TEST_F(Axis_power, Brakes_before_it_goes) {
  const Given power = hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  const Given move = give(1, AxisService::MoveVelocity, 0, 40);
  ASSERT_TRUE(cell.until([&] { return reached(move); }));
  command(power).execute = 0;
  ASSERT_TRUE(cell.until([&] { return axis(0) == AxisState::Disabled; }));
  EXPECT_EQ(state(move), CommandState::Aborted);
  EXPECT_EQ(cell.out.speed[0], 0);
}

TEST_F(Axis_power, Comes_back_after_an_emergency_and_a_reset_of_the_axis) {
  hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  cell.in.emergency = true;
  ASSERT_TRUE(becomes(AxisState::ErrorStop));
  const Given early = give(1, AxisService::Reset);
  ASSERT_TRUE(cell.until([&] { return ended(early); }));
  EXPECT_EQ(error(early), ErrorCode::Emergency) << "not before it is over";
  cell.in.emergency = false;
  EXPECT_TRUE(stays(AxisState::ErrorStop)) << "and not on its own";
  EXPECT_NE(cell.in.drives[0].status & 0x6FU, 0x27U);
  EXPECT_TRUE(done(give(1, AxisService::Reset)));
  EXPECT_TRUE(becomes(AxisState::Standstill));
  EXPECT_TRUE(done(give(1, AxisService::MoveRelative, 5, 20)));
  // The group has not been reset, and the next emergency stops the axis again.
  give(1, AxisService::MoveVelocity, 0, 20);
  ASSERT_TRUE(becomes(AxisState::ContinuousMotion));
  cell.in.emergency = true;
  EXPECT_TRUE(becomes(AxisState::ErrorStop));
  EXPECT_NEAR(cell.out.speed[0], 0, 1e-9);
}

TEST_F(Axis_power, Of_an_axis_that_was_reset_outlives_the_reset_of_the_group) {
  hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  cell.in.emergency = true;
  ASSERT_TRUE(becomes(AxisState::ErrorStop));
  cell.in.emergency = false;
  ASSERT_TRUE(done(give(1, AxisService::Reset)));
  ASSERT_TRUE(becomes(AxisState::Standstill));
  const Given move = give(1, AxisService::MoveRelative, 30, 20);
  ASSERT_TRUE(becomes(AxisState::DiscreteMotion)) << to_string(error(move)) << static_cast<int>(axis(0));
  ASSERT_TRUE(cell.serve(Service::GroupReset));
  EXPECT_TRUE(done(move)) << "a moving axis does not lose its power";
}

TEST_F(Axis_power, That_is_lost_is_an_error_until_a_reset) {
  hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  cell.in.drives[0].status = Cell::kFault;
  cell.step();
  EXPECT_EQ(axis(0), AxisState::ErrorStop);
  EXPECT_EQ(cell.out.axes[0].error, ErrorCode::Drive);
  EXPECT_TRUE(stays(AxisState::ErrorStop));
  EXPECT_TRUE(done(give(1, AxisService::Reset)));
  EXPECT_TRUE(becomes(AxisState::Standstill));
}

TEST_F(Axis_power, Stays_when_the_group_gives_up_its_own) {
  hold_power(1);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  ASSERT_TRUE(cell.serve(Service::GroupDisable));
  ASSERT_TRUE(cell.until([&] { return axis(1) == AxisState::Disabled; }));
  EXPECT_TRUE(stays(AxisState::Standstill));
}

// In Standby, axes may move on their own: they come to rest before the group gives up its power, too.
TEST_F(Axis_power, Is_given_up_by_the_group_after_single_axes_have_come_to_rest) {
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  const Given move = give(1, AxisService::MoveVelocity, 0, 40);
  ASSERT_TRUE(cell.until([&] { return reached(move); }));
  double before = cell.out.speed[0];
  double steepest = 0;
  cell.ask(Service::GroupDisable);
  ASSERT_TRUE(cell.until([&] {
    steepest = std::max(steepest, std::abs(cell.out.speed[0] - before));
    before = cell.out.speed[0];
    return cell.out.state == GroupState::Disabled || cell.out.state == GroupState::ErrorStop;
  }));
  EXPECT_EQ(cell.out.state, GroupState::Disabled) << to_string(cell.out.error);
  EXPECT_EQ(state(move), CommandState::Aborted);
  EXPECT_LT(steepest, 20) << "deg/s from one period to the next";
  ASSERT_TRUE(cell.serve(Service::GroupEnable)) << "without a reset";
}

TEST_F(Axis_power, That_falls_while_the_group_moves_stops_the_group) {
  const Given power = hold_power(2);
  ASSERT_TRUE(cell.serve(Service::GroupEnable));
  const Given move = give(Service::DirectAbsolute, {40, 0, 0, 0, 0, 0}, 20);
  ASSERT_TRUE(cell.until([&] { return cell.out.speed[0] > 1; }));
  command(power).execute = 0;
  ASSERT_TRUE(cell.until([&] { return cell.out.state == GroupState::ErrorStop; }));
  EXPECT_EQ(cell.out.error, ErrorCode::Power);
  EXPECT_EQ(cell.out.error_axis, 2U);
  EXPECT_EQ(error(move), ErrorCode::Power);
  EXPECT_TRUE(cell.until([&] { return (cell.in.drives[1].status & 0x6FU) != 0x27; }));
}

TEST_F(Axis_power, Is_another_command_s_to_take) {
  const Given first = hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  const Given second = hold_power(1);
  cell.step();
  EXPECT_EQ(state(first), CommandState::Aborted);
  command(first).execute = 0;
  EXPECT_TRUE(stays(AxisState::Standstill));
  EXPECT_TRUE(done(give(1, AxisService::PowerOff)));
  EXPECT_EQ(state(second), CommandState::Aborted);
  EXPECT_TRUE(stays(AxisState::Disabled));
}

// GroupEnable is refused in an emergency; that is no reason for an axis to move in it.
TEST_F(Axis_power, In_an_emergency_moves_nothing) {
  cell.in.emergency = true;
  cell.step();
  EXPECT_FALSE(cell.serve(Service::GroupEnable));
  EXPECT_EQ(cell.out.error, ErrorCode::Emergency);
  give(1, AxisService::PowerOn);
  cell.step();
  for (int i = 0; i < 500; ++i) {
    give(1, AxisService::MoveVelocity, 0, 20);
    cell.step();
    ASSERT_EQ(cell.out.speed[0], 0);
  }
}

TEST_F(Axis_power, An_axis_that_does_not_follow_fails_though_the_group_has_no_power) {
  hold_power(1);
  ASSERT_TRUE(becomes(AxisState::Standstill));
  const Given move = give(1, AxisService::MoveRelative, 60, 40);
  ASSERT_TRUE(becomes(AxisState::DiscreteMotion));
  cell.stuck = true;
  EXPECT_TRUE(becomes(AxisState::ErrorStop));
  EXPECT_EQ(error(move), ErrorCode::Following);
  EXPECT_LT(cell.out.command[0], 40);
}

TEST_F(Axis_power, That_was_wanted_for_a_moment_only_is_not_there) {
  command(hold_power(1)).execute = 0;
  EXPECT_TRUE(stays(AxisState::Disabled));
}

// Random emergencies, resets, faults and falls of Execute: once all is well, the power is what Execute says.
TEST_F(Axis_power, Is_what_the_command_says_in_the_end) {
  std::mt19937 random(7);
  Given power = hold_power(1);
  for (int round = 0; round < 300; ++round) {
    for (auto i = random() % 60; i > 0; --i) {
      switch (random() % 12) {
        case 0:
          cell.in.emergency = !cell.in.emergency;
          break;
        case 1:
          cell.in.drives[0].status = Cell::kFault;
          break;
        case 2:
          give(1, AxisService::Reset);
          break;
        case 3:
          cell.ask(random() % 2 == 0 ? Service::GroupReset : Service::GroupDisable);
          break;
        case 4:
          give(1, AxisService::MoveRelative, static_cast<double>(random() % 21) - 10, 30);
          break;
        case 5:
          command(power).execute = 0;
          power = hold_power(1);
          break;
        default:
          break;
      }
      cell.step();
    }
    cell.in.emergency = false;
    ASSERT_TRUE(cell.until([&] { return cell.out.done == cell.in.service.number; }));
    const bool on = random() % 2 == 0;
    if (state(power) == CommandState::Error || state(power) == CommandState::Aborted) {
      power = hold_power(1);  // as the block does
    }
    command(power).execute = on ? 1 : 0;
    cell.step();
    Given reset = give(1, AxisService::Reset);
    // Some may come while it still brakes for its power to go.
    for (int tries = 0; tries < 100 && !done(reset); ++tries) {
      reset = give(1, AxisService::Reset);
    }
    ASSERT_TRUE(becomes(on ? AxisState::Standstill : AxisState::Disabled))
        << "round " << round << ", state " << static_cast<int>(axis(0)) << " of the group "
        << static_cast<int>(cell.out.state) << " power " << static_cast<int>(state(power));
    ASSERT_TRUE(stays(on ? AxisState::Standstill : AxisState::Disabled))
        << "round " << round << " on " << on << " state " << static_cast<int>(axis(0)) << " group "
        << static_cast<int>(cell.out.state) << to_string(cell.out.axes[0].error) << static_cast<int>(state(power));
    ASSERT_EQ(cell.out.axes[0].power, on);
    if (!on) {
      power = hold_power(1);
    }
  }
}

}  // namespace
}  // namespace indurop::robot
