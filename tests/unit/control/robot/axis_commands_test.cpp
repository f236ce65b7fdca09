// SPDX-License-Identifier: Apache-2.0
// Commands of single axes, as function blocks give them: each one learns its own end.
#include "command_cell.h"
#include "control/robot/axis/command_table.h"

namespace indurop::robot {
namespace {

class AxisCommands : public testing::Test, public CommandCell {
 protected:
  void SetUp() override { ASSERT_TRUE(done(give(1, AxisService::PowerOn))); }
  // The speed with which axis 1 passes an angle.
  double speed_at(double angle) {
    const bool up = joint(0) < angle;
    EXPECT_TRUE(cell.until([&] { return up ? joint(0) >= angle - 1e-9 : joint(0) <= angle + 1e-9; }));
    return cell.out.axes[0].velocity;
  }
};

TEST_F(AxisCommands, Several_of_one_period_run_one_after_the_other) {
  const Given first = give(1, AxisService::MoveAbsolute, 10, 90);
  const Given second = give(1, AxisService::MoveAbsolute, 25, 90, BufferMode::Buffered);
  const Given third = give(1, AxisService::MoveRelative, -5, 90, BufferMode::Buffered);
  cell.step();
  EXPECT_EQ(state(first), CommandState::Active);
  EXPECT_EQ(state(second), CommandState::Waits);
  ASSERT_TRUE(done(first));
  EXPECT_NEAR(joint(0), 10, 0.01);
  EXPECT_EQ(state(second), CommandState::Active);
  ASSERT_TRUE(done(second));
  EXPECT_NEAR(joint(0), 25, 0.01);
  ASSERT_TRUE(done(third));
  EXPECT_NEAR(joint(0), 20, 0.01);
  EXPECT_EQ(axis(0), AxisState::Standstill);
}

TEST_F(AxisCommands, An_aborting_one_ends_those_before_it) {
  const Given first = give(1, AxisService::MoveAbsolute, 60, 30);
  const Given second = give(1, AxisService::MoveAbsolute, 90, 30, BufferMode::Buffered);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 10; }));
  const Given third = give(1, AxisService::MoveAbsolute, 0);
  cell.step();
  EXPECT_EQ(state(first), CommandState::Aborted);
  EXPECT_EQ(state(second), CommandState::Aborted);
  ASSERT_TRUE(done(third));
  EXPECT_NEAR(joint(0), 0, 0.01);
}

TEST_F(AxisCommands, One_that_cannot_be_done_leaves_the_others_alone) {
  const Given first = give(1, AxisService::MoveAbsolute, 20, 60);
  cell.step();
  const Given beyond = give(1, AxisService::MoveAbsolute, 999);
  const Given no_number = give(1, AxisService::MoveAbsolute, std::nan(""));
  const Given nowhere = give(9, AxisService::MoveAbsolute, 1);
  const Given unknown = give(1, static_cast<AxisService>(77));
  cell.step();
  EXPECT_EQ(error(beyond), ErrorCode::JointLimit);
  EXPECT_EQ(error(no_number), ErrorCode::Value);
  EXPECT_EQ(error(nowhere), ErrorCode::Value);
  EXPECT_EQ(error(unknown), ErrorCode::Opcode);
  EXPECT_TRUE(done(first));
}

TEST_F(AxisCommands, Blending_passes_the_end_with_the_speed_that_the_mode_says) {
  const std::pair<BufferMode, double> modes[] = {{BufferMode::Buffered, 0},
                                                 {BufferMode::BlendingLow, 30},
                                                 {BufferMode::BlendingPrevious, 60},
                                                 {BufferMode::BlendingNext, 30},
                                                 {BufferMode::BlendingHigh, 60}};
  for (const auto& [mode, speed] : modes) {
    SCOPED_TRACE(static_cast<int>(mode));
    ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 0)));
    const Given first = give(1, AxisService::MoveAbsolute, 40, 60);
    const Given second = give(1, AxisService::MoveAbsolute, 80, 30, mode);
    EXPECT_NEAR(speed_at(40), speed, 0.5);
    EXPECT_TRUE(done(first));
    EXPECT_TRUE(done(second));
    EXPECT_NEAR(joint(0), 80, 1e-6);
  }
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 0)));
  give(1, AxisService::MoveAbsolute, 40, 30);
  const Given faster = give(1, AxisService::MoveAbsolute, 80, 60, BufferMode::BlendingNext);
  EXPECT_LT(speed_at(20), 30.5) << "it gets faster just before its end";
  EXPECT_NEAR(speed_at(40), 60, 0.5);
  EXPECT_TRUE(done(faster));
}

TEST_F(AxisCommands, Blending_into_the_other_direction_stops) {
  give(1, AxisService::MoveAbsolute, 30, 60);
  const Given back = give(1, AxisService::MoveAbsolute, 10, 60, BufferMode::BlendingHigh);
  double most = 0;
  ASSERT_TRUE(cell.until([&] {
    most = std::max(most, joint(0));
    return ended(back);
  }));
  EXPECT_LT(most, 30 + 1e-6);
  EXPECT_NEAR(joint(0), 10, 0.01);
}

TEST_F(AxisCommands, A_stop_holds_as_long_as_its_block_says) {
  const Given move = give(1, AxisService::MoveVelocity, 0, 30);
  ASSERT_TRUE(cell.until([&] { return reached(move); }));
  EXPECT_EQ(axis(0), AxisState::ContinuousMotion);
  const Given stop = give(1, AxisService::Stop);
  cell.step();
  EXPECT_EQ(state(move), CommandState::Aborted);
  ASSERT_TRUE(done(stop));
  const Given refused = give(1, AxisService::MoveAbsolute, 1);
  cell.step();
  EXPECT_EQ(error(refused), ErrorCode::State);
  EXPECT_EQ(axis(0), AxisState::Stopping);
  command(stop).execute = 0;
  cell.step();
  EXPECT_EQ(axis(0), AxisState::Standstill);
  EXPECT_EQ(state(stop), CommandState::Done);
  EXPECT_TRUE(done(give(1, AxisService::MoveAbsolute, 1)));
}

TEST_F(AxisCommands, A_halt_can_be_taken_over) {
  give(1, AxisService::MoveVelocity, 0, 60);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 20; }));
  const Given halt = give(1, AxisService::Halt);
  cell.step();
  EXPECT_EQ(axis(0), AxisState::DiscreteMotion);
  const Given on = give(1, AxisService::MoveVelocity, 0, -60);
  cell.step();
  EXPECT_EQ(state(halt), CommandState::Aborted);
  ASSERT_TRUE(cell.until([&] { return reached(on); }));
  const Given last = give(1, AxisService::Halt);
  ASSERT_TRUE(done(last));
  EXPECT_EQ(axis(0), AxisState::Standstill);
}

TEST_F(AxisCommands, An_added_distance_counts_from_the_target_before) {
  give(1, AxisService::MoveAbsolute, 30, 60);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 10; }));
  ASSERT_TRUE(done(give(1, AxisService::MoveAdditive, 15)));
  EXPECT_NEAR(joint(0), 45, 0.01);
  ASSERT_TRUE(done(give(1, AxisService::MoveAdditive, -5)));
  EXPECT_NEAR(joint(0), 40, 0.01);
}

TEST_F(AxisCommands, Deceleration_may_be_another_than_acceleration) {
  Command& c = command(give(1, AxisService::MoveAbsolute, 60, 60));
  c.acceleration = 200;
  c.deceleration = 50;
  double up = 0;
  double down = 0;
  ASSERT_TRUE(cell.until([&] {
    up = std::max(up, cell.out.axes[0].acceleration);
    down = std::min(down, cell.out.axes[0].acceleration);
    return joint(0) > 60 - 1e-6;
  }));
  EXPECT_NEAR(up, 200, 1);
  EXPECT_NEAR(down, -50, 1);
}

TEST_F(AxisCommands, A_position_that_is_set_moves_nothing) {
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 30)));
  ASSERT_TRUE(done(give(1, AxisService::SetPosition, 100)));
  cell.step();
  EXPECT_NEAR(cell.out.axes[0].position, 100, 0.01);
  EXPECT_NEAR(joint(0), 30, 0.01);
  ASSERT_TRUE(done(give(1, AxisService::MoveAbsolute, 110)));
  EXPECT_NEAR(joint(0), 40, 0.01);
  const Given by = give(1, AxisService::SetPosition, 10);
  command(by).option = 1;
  ASSERT_TRUE(done(by));
  cell.step();
  EXPECT_NEAR(cell.out.axes[0].position, 120, 0.01);
  EXPECT_EQ(error(give(1, AxisService::MoveAbsolute, 1000)), ErrorCode::Ok);
}

TEST_F(AxisCommands, What_a_block_changes_counts_at_once) {
  const Given move = give(1, AxisService::MoveAbsolute, 90, 20);
  ASSERT_TRUE(cell.until([&] { return joint(0) > 10; }));
  command(move).to[0] = 30;
  command(move).velocity = 40;
  ++command(move).updates;
  double most = 0;
  ASSERT_TRUE(cell.until([&] {
    most = std::max(most, cell.out.axes[0].velocity);
    return ended(move);
  }));
  EXPECT_EQ(state(move), CommandState::Done);
  EXPECT_NEAR(joint(0), 30, 0.01);
  EXPECT_NEAR(most, 40, 0.5);
}

TEST_F(AxisCommands, Factors_slow_down_what_they_name) {
  cell.in.factors.velocity[0] = 0.5;
  const Given move = give(1, AxisService::MoveVelocity, 0, 40);
  ASSERT_TRUE(cell.until([&] { return reached(move); }));
  EXPECT_NEAR(cell.out.axes[0].velocity, 20, 0.1);
  cell.in.factors.velocity[0] = 1;
  cell.step();
  ASSERT_TRUE(cell.until([&] { return reached(move); }));
  EXPECT_NEAR(cell.out.axes[0].velocity, 40, 0.1);
}

TEST_F(AxisCommands, More_than_there_is_room_for_are_refused) {
  cell.in.hold = true;
  give(1, AxisService::MoveVelocity, 0, 1);
  for (int i = 1; i < CommandTable::kMaxCommands; ++i) {
    give(1, AxisService::MoveAbsolute, 1, 1, BufferMode::Buffered);
    cell.step();
  }
  // The targets have been written again, so the first ones are no longer awaited.
  const Given last = give(1, AxisService::MoveAbsolute, 1, 1, BufferMode::Buffered);
  cell.step();
  EXPECT_EQ(state(last), CommandState::Error);
  EXPECT_EQ(error(last), ErrorCode::Full);
}

TEST(Commands, What_was_asked_before_the_start_is_not_done) {
  Cell cell("", 10, 0, false);
  cell.in.commands[3].number = 17;
  cell.in.commands[3].axis = 1;
  cell.in.commands[3].code = static_cast<std::int32_t>(AxisService::PowerOn);
  cell.step();
  EXPECT_EQ(cell.out.commands[3].state, CommandState::None) << "the board has not been heard";
  cell.in.requests_known = true;
  cell.step();
  EXPECT_EQ(cell.out.commands[3].number, 17U);
  EXPECT_EQ(cell.out.commands[3].state, CommandState::Aborted);
  for (int i = 0; i < 20; ++i) {
    cell.step();
  }
  EXPECT_FALSE(cell.out.axes[0].power);
}

}  // namespace
}  // namespace indurop::robot
